"""A branch may add or amend one submission and nothing else, and nothing in it is executed or followed."""

import hashlib
from dataclasses import dataclass
from pathlib import Path

import pytest

from git_trees import LINK, PROGRAM, SUBMODULE, GitTrees, Tree
from leaderboard.assessing import assess
from leaderboard.changes import ChangeCheck, check_changes
from leaderboard.changes.git_objects import GitError
from leaderboard.grading import result_bytes
from leaderboard.instance import Instance
from leaderboard.reference import Reference, load_reference
from leaderboard.submission import RawFile, RawSubmission
from raw_submissions import SUBMISSION_TOML, TODAY, predictions_csv, spread_probabilities
from reference_folders import ReferenceFolder

FOLDER = "submissions/example"
BAD_NAMES = ["..", ".git", "a\nb", "$(touch hacked)", "-rf", "`x`", "::error::x", "\u202egpj.x", "x" * 300]


@dataclass(frozen=True)
class Double:
    """An instance in a repository, with what a branch may hold."""

    instance: Instance
    reference: Reference
    git: GitTrees
    base: str

    def submission(self, slug: str = "example", *, toml: str = SUBMISSION_TOML) -> dict[str, bytes]:
        """Make the three files of a valid submission, by path."""
        contents = {
            "submission.toml": toml.encode(),
            "predictions.csv": predictions_csv(self.reference).encode(),
        }
        files = tuple(RawFile(name, "file", len(data), data) for name, data in contents.items())
        raw = RawSubmission(f"submissions/{slug}", slug, files)
        result = assess(raw, self.reference, today=TODAY).result
        assert result is not None
        contents["result.json"] = result_bytes(result)
        return {f"submissions/{slug}/{name}": data for name, data in contents.items()}

    def check(self, files: Tree, *, base: str | None = None, author: str | None = "someone") -> ChangeCheck:
        """Commit files on top of a base and judge that."""
        start = self.base if base is None else base
        head = self.git.commit(files, start)
        return check_changes(self.instance, self.reference, (start, head), author=author, today=TODAY)


@pytest.fixture
def double(tmp_path: Path) -> Double:
    instance = ReferenceFolder().write(tmp_path / "instance")
    git = GitTrees(instance.root).init()
    return Double(instance, load_reference(instance), git, git.commit({"README.md": b"x"}))


def with_readme(files: Tree) -> Tree:
    return {"README.md": b"x", **files}


def describe(check: ChangeCheck) -> list[tuple[str, str]]:
    return [(problem.code, problem.file) for problem in check.problems]


def test_a_new_submission_with_its_result_is_fine(double: Double) -> None:
    """Three files in one folder, whose contact sent them: nothing to say."""
    check = double.check(with_readme(double.submission()))
    assert (check.slug, check.problems, check.is_fine) == ("example", (), True)
    assert check.assessment is not None
    assert check.assessment.result is not None


def test_logins_are_compared_without_capitals(double: Double) -> None:
    """GitHub's logins have no capitals of their own."""
    assert double.check(with_readme(double.submission()), author="SomeOne").problems == ()


def test_who_sends_a_new_submission_should_be_its_contact(double: Double) -> None:
    """Another contact is a warning; an unknown sender another."""
    files = with_readme(double.submission())
    (problem,) = double.check(files, author="other").problems
    assert (problem.code, problem.message) == (
        "change-contact",
        "the contact is someone, but the change is other's",
    )
    check = double.check(files, author=None)
    assert [p.code for p in check.problems] == ["change-unchecked-author"]
    assert check.is_fine


def test_nothing_else_may_change(double: Double) -> None:
    """Each path outside of the folder is named, whether it is new, changed or gone."""
    files = {**double.submission(), "leaderboard/grading.py": b"cheat", ".github/workflows/x.yml": b""}
    assert describe(double.check(files)) == [
        ("change-outside", ".github/workflows/x.yml"),
        ("change-outside", "README.md"),
        ("change-outside", "leaderboard/grading.py"),
    ]


def test_files_beside_the_folders_are_outside(double: Double) -> None:
    """The ledger is written by publishing alone."""
    files = with_readme({**double.submission(), "submissions/ledger.csv": b"x"})
    assert describe(double.check(files)) == [("change-outside", "submissions/ledger.csv")]


def test_one_submission_at_a_time(double: Double) -> None:
    """Two slugs are refused before anything is graded."""
    check = double.check(with_readme({**double.submission(), **double.submission("other")}))
    assert check.slug is None
    assert [(p.code, p.message) for p in check.problems] == [
        ("change-several", "2 submissions change: 'example', 'other'")
    ]


def test_no_change_is_no_submission(double: Double) -> None:
    """A branch without a difference is said to be one."""
    assert describe(double.check(with_readme({}))) == [("change-nothing", ".")]


@pytest.mark.parametrize("name", ["predictions.csv", "submission.toml", "result.json"])
@pytest.mark.parametrize(
    ("mode", "target"), [(LINK, b"/etc/passwd"), (LINK, b"../../README.md"), (SUBMODULE, b"")]
)
def test_links_and_submodules_are_refused_unread(double: Double, name: str, mode: str, target: bytes) -> None:
    """What is no plain file has no content here, wherever it points."""
    files = with_readme({**double.submission(), f"{FOLDER}/{name}": (mode, target)})
    check = double.check(files)
    assert ("not-a-plain-file", f"{FOLDER}/{name}") in describe(check)
    assert check.assessment is not None
    found = check.assessment.raw.find(name)
    assert found is not None
    assert found.content is None


def test_programs_are_refused(double: Double) -> None:
    """A file with the bit for execution is named with the command that takes it off."""
    own = double.submission()
    check = double.check(
        with_readme({**own, f"{FOLDER}/result.json": (PROGRAM, own[f"{FOLDER}/result.json"])})
    )
    assert [(p.code, p.file, p.message) for p in check.problems] == [
        ("change-mode", f"{FOLDER}/result.json", "is marked as a program; it must be a plain file")
    ]


@pytest.mark.parametrize(
    "name", [*BAD_NAMES, "Predictions.csv", "predicti\u043ens.csv", ".gitattributes", "a/b"]
)
def test_other_names_are_refused(double: Double, name: str) -> None:
    """Whatever a file is called, it is named in one printable line, and nothing becomes of it."""
    check = double.check(with_readme({**double.submission(), f"{FOLDER}/{name}": b"x"}))
    assert [p.code for p in check.problems] == ["unexpected-file"]
    assert all(f"{p.file}{p.message}".isprintable() for p in check.problems)
    assert not (double.instance.root / "hacked").exists()


@pytest.mark.parametrize("slug", [*BAD_NAMES, "Example", "-x", "ex ample", "ex\u0430mple"])
def test_other_folders_are_refused(double: Double, slug: str) -> None:
    """A folder that cannot be a slug is judged as such, whatever it is called."""
    files = {
        f"submissions/{slug}/{name.rpartition('/')[2]}": data for name, data in double.submission().items()
    }
    check = double.check(with_readme(files))
    assert not check.is_fine
    assert "slug-malformed" in {p.code for p in check.problems}
    assert all(f"{p.file}{p.message}".isprintable() for p in check.problems)


def test_large_files_are_not_read(double: Double) -> None:
    """30 MB are refused by their size."""
    files = with_readme({**double.submission(), f"{FOLDER}/predictions.csv": b"0" * 30_000_000})
    check = double.check(files)
    assert ("file-too-large", f"{FOLDER}/predictions.csv") in describe(check)
    assert check.assessment is not None
    found = check.assessment.raw.find("predictions.csv")
    assert found is not None
    assert (found.size, found.content) == (30_000_000, None)


def test_thousands_of_files_are_counted(double: Double) -> None:
    """A branch of 3,000 files is refused with one problem for each."""
    files = with_readme({**double.submission(), **{f"junk/{n}": b"" for n in range(3000)}})
    assert [p.code for p in double.check(files).problems] == ["change-outside"] * 3000


def test_lfs_pointers_are_not_predictions(double: Double) -> None:
    """A pointer is the text that it is; nothing fetches what it points to."""
    pointer = b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n"
    check = double.check(with_readme({**double.submission(), f"{FOLDER}/predictions.csv": pointer}))
    assert not check.is_fine
    assert check.assessment is not None
    assert check.assessment.result is None


def test_filters_are_not_applied(double: Double) -> None:
    """Attributes and configured filters change nothing: blobs are read as they are."""
    double.git.run("config", "filter.evil.smudge", "touch hacked")
    double.git.run("config", "filter.evil.required", "true")
    own = double.submission()
    base = double.git.commit({".gitattributes": b"* filter=evil text eol=crlf"}, double.base)
    check = double.check({".gitattributes": b"* filter=evil text eol=crlf", **own}, base=base)
    assert check.problems == ()
    assert not (double.instance.root / "hacked").exists()


def test_a_wrong_result_is_named(double: Double) -> None:
    """A forged number is told with the right one."""
    own = double.submission()
    forged = own[f"{FOLDER}/result.json"].replace(b'"answered": 12', b'"answered": 11')
    check = double.check(with_readme({**own, f"{FOLDER}/result.json": forged}))
    assert [(p.code, p.message, p.hint) for p in check.problems] == [
        ("change-result", "coverage.answered is 11, should be 12", f"leaderboard grade {FOLDER}")
    ]


def test_a_missing_result_is_named(double: Double) -> None:
    """Without result.json there is nothing to compare with."""
    own = double.submission()
    del own[f"{FOLDER}/result.json"]
    assert describe(double.check(with_readme(own))) == [("change-result", f"{FOLDER}/result.json")]


def test_nobody_calls_themselves_a_baseline(double: Double) -> None:
    """Baselines stand on every board, so the family is not for the taking."""
    own = double.submission(toml=SUBMISSION_TOML.replace("object-centric", "baseline"))
    assert describe(double.check(with_readme(own))) == [("change-baseline", f"{FOLDER}/submission.toml")]


def published(double: Double) -> tuple[str, dict[str, bytes]]:
    own = double.submission()
    return double.git.commit(with_readme(own), double.base), own


@pytest.mark.parametrize(
    ("old", "new", "is_fine"),
    [
        ('name = "Example"', 'name = "Example 2"', True),
        ('github = "someone"', 'github = "successor"', True),
        ('testing = "with_property"', 'testing = "without_property"', False),
        ('system = "example"', 'system = "another"', False),
    ],
)
def test_a_contact_may_amend_what_decides_nothing(
    double: Double, old: str, new: str, *, is_fine: bool
) -> None:
    """Texts and contact may change; protocol and system are frozen."""
    base, _ = published(double)
    check = double.check(with_readme(double.submission(toml=SUBMISSION_TOML.replace(old, new))), base=base)
    expected = [] if is_fine else [("change-frozen", f"{FOLDER}/submission.toml")]
    assert describe(check) == expected


@pytest.mark.parametrize("author", ["other", "someone-else"])
def test_nobody_else_may_amend(double: Double, author: str) -> None:
    """The contact that counts is the published one, not the one that the branch writes."""
    base, _ = published(double)
    toml = SUBMISSION_TOML.replace('"someone"', f'"{author}"')
    check = double.check(with_readme(double.submission(toml=toml)), base=base, author=author)
    assert [(p.code, p.message) for p in check.problems] == [
        ("change-foreign", f"this submission is someone's, and the change is {author}'s")
    ]


def test_published_predictions_never_change(double: Double) -> None:
    """Not even their contact may change them, nor remove them."""
    base, own = published(double)
    other = predictions_csv(double.reference, spread_probabilities(double.reference)[::-1]).encode()
    check = double.check(with_readme({**own, f"{FOLDER}/predictions.csv": other}), base=base)
    assert ("change-frozen", f"{FOLDER}/predictions.csv") in describe(check)
    assert describe(double.check(with_readme({}), base=base)) == [("change-frozen", FOLDER)]


def test_a_withdrawn_slug_is_not_used_again(double: Double) -> None:
    """Whether its folder is still there or not, the ledger remembers."""
    own = double.submission()
    sha256 = hashlib.sha256(own[f"{FOLDER}/result.json"]).hexdigest()
    lines = [f"2026-05-20,example,{event},a reason,{sha256}" for event in ("added", "withdrawn")]
    double.instance.submissions_dir.mkdir()
    ledger = "\n".join(["date,slug,event,reason,result_sha256", *lines, ""])
    double.instance.ledger_file.write_text(ledger)
    assert [(p.code, p.message) for p in double.check(with_readme(own)).problems] == [
        ("change-frozen", "example was withdrawn, and the slug is not used again")
    ]


def test_only_the_branchs_own_changes_count(double: Double) -> None:
    """What the published side got since then is not the branch's doing."""
    head = double.git.commit(with_readme(double.submission()), double.base)
    base = double.git.commit(with_readme({"docs/new.md": b"x"}), double.base)
    check = check_changes(double.instance, double.reference, (base, head), author="someone", today=TODAY)
    assert check.problems == ()


def test_a_slug_that_was_taken_meanwhile_is_foreign(double: Double) -> None:
    """Between sending and merging somebody else's submission of the name was published."""
    head = double.git.commit(with_readme(double.submission()), double.base)
    first = SUBMISSION_TOML.replace('"someone"', '"first"')
    base = double.git.commit(with_readme(double.submission(toml=first)), double.base)
    check = check_changes(double.instance, double.reference, (base, head), author="someone", today=TODAY)
    assert ("change-foreign", f"{FOLDER}/submission.toml") in describe(check)


@pytest.mark.parametrize(("old", "new"), [("Example Lab", "First Lab"), ('"someone"', '"first"')])
def test_copies_of_other_submissions_are_told(
    double: Double, monkeypatch: pytest.MonkeyPatch, old: str, new: str
) -> None:
    """Predictions of another team are recognised, and so are those of a team whose name alone is the same."""
    monkeypatch.setattr("leaderboard.validation.warnings.MIN_SHARED", double.reference.n_trials)
    folder = double.instance.submission_dir("first")
    folder.mkdir(parents=True)
    toml = SUBMISSION_TOML.replace(old, new)
    for path, data in double.submission("first", toml=toml).items():
        (folder / path.rpartition("/")[2]).write_bytes(data)
    check = double.check(with_readme(double.submission()))
    assert "copy-of-another" in {p.code for p in check.problems}


@pytest.mark.parametrize("revision", ["nothing", "--help", "HEAD; touch hacked", "a\nb", ""])
def test_revisions_that_are_none_are_refused(double: Double, revision: str) -> None:
    """A name that is no commit is an error in one line, never an option or a command."""
    with pytest.raises(GitError, match="names no commit here"):
        check_changes(double.instance, double.reference, (double.base, revision), author=None, today=TODAY)
    assert not (double.instance.root / "hacked").exists()


def test_strangers_histories_are_refused(double: Double) -> None:
    """Commits without a common ancestor cannot be compared."""
    head = double.git.commit(with_readme(double.submission()))
    with pytest.raises(GitError, match="share no history"):
        check_changes(double.instance, double.reference, (double.base, head), author=None, today=TODAY)


def test_an_instance_may_lie_in_a_folder_of_a_repository(tmp_path: Path) -> None:
    """Paths are those within the repository, wherever the instance is."""
    instance = ReferenceFolder().write(tmp_path / "inner")
    git = GitTrees(tmp_path).init()
    inner = Double(instance, load_reference(instance), git, git.commit({"README.md": b"x"}))
    files = {f"inner/{path}": data for path, data in inner.submission().items()}
    assert inner.check(with_readme(files)).slug == "example"
    assert describe(inner.check(with_readme(inner.submission())))[0][0] == "change-outside"
