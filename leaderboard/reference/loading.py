"""Loading a reference for grading, or refusing it."""

from leaderboard.instance import Instance
from leaderboard.reference.data import Reference
from leaderboard.reference.definition import read_manifest
from leaderboard.reference.sealing import broken_reference, check_seal
from leaderboard.reference.tables import read_tables


def load_reference(instance: Instance, *, with_responses: bool = True) -> Reference:
    """Load the reference of an instance and prove that its files are those that were sealed.

    ``with_responses=False`` leaves out the responses of single people, whose file is then only proven by
    its checksum: judging a submission does not need them.

    Raises
    ------
    BrokenReferenceError
        If a file is missing, malformed, contradicts another or differs from its checksum. The message names
        the first problem and counts the others; `leaderboard.reference.checking.check_reference` lists all.
    """
    tables, problems = read_tables(instance, with_responses=with_responses)
    manifest = read_manifest(instance, problems)
    if tables is not None and manifest is not None:
        check_seal(tables.contents, manifest, problems)
    if tables is None or manifest is None or problems.has_errors:
        raise broken_reference(problems)
    return tables.bind(manifest)
