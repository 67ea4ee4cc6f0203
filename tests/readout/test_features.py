"""Features as a value: what is taken, what is refused, and that labels are looked at only on demand."""

import hashlib
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from leaderboard.errors import SourceError
from leaderboard.readout import features
from leaderboard.readout.features import features_from_columns

IDS = np.array(["a", "b", "c"])


class Untouchable(dict[str, Any]):
    """Columns of which one must not be looked at."""

    def __init__(self, columns: dict[str, Any], forbidden: str) -> None:
        super().__init__(columns)
        self.forbidden = forbidden

    def __getitem__(self, name: str) -> Any:
        assert name != self.forbidden
        return super().__getitem__(name)


def columns(**more: Any) -> dict[str, Any]:
    return {"trial_id": IDS, "features": np.arange(6.0).reshape(3, 2), **more}


def test_columns_become_features() -> None:
    """Ids, pairs, properties, labels and numbers come out as they went in."""
    given = columns(pair_id=["p", "p", "q"], property=["Mass"] * 3, label=[0, True, 1.0])
    taken = features_from_columns(given, with_labels=True)
    assert taken.trial_ids == ("a", "b", "c")
    assert (taken.pair_ids, taken.properties) == (("p", "p", "q"), ("Mass",) * 3)
    assert taken.labels is not None
    assert taken.labels.tolist() == [0, 1, 1]
    texts = features_from_columns(columns(label=["0", "1", "1"]), with_labels=True)
    assert texts.labels is not None
    assert texts.labels.tolist() == [0, 1, 1]
    assert taken.values.tolist() == [[0, 1], [2, 3], [4, 5]]


def test_labels_are_not_looked_at_unless_asked_for() -> None:
    """Without being asked for, a column of labels is not even read."""
    given = Untouchable(columns(label=[1, 1, 0]), "label")
    assert features_from_columns(given, with_labels=False).labels is None


def test_numbered_columns_are_features_and_others_are_not() -> None:
    """Columns feature_... are features in their order; a column of another name never becomes one."""
    table = {
        "trial_id": IDS,
        "feature_b": [1, 2, 3],
        "labels": [1, 0, 1],
        "y": [1, 0, 1],
        "feature_a": [4, 5, 6],
    }
    taken = features_from_columns(table, with_labels=False)
    assert taken.values.tolist() == [[1, 4], [2, 5], [3, 6]]


def test_lists_are_stacked() -> None:
    """A column of lists, as data frames hold them, is a matrix, and one of matrices has frames."""
    lists = np.empty(3, object)
    lists[:] = [[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]
    assert features_from_columns(columns(features=lists), with_labels=False).values.shape == (3, 2)
    frames = [[[1, 2], [3, 4]]] * 3
    taken = features_from_columns(columns(features=frames), pooling="max", with_labels=False)
    assert taken.values.tolist() == [[3, 4]] * 3


def test_hash_is_that_of_the_stored_numbers() -> None:
    """The hash is that of the array's bytes, before pooling and in whatever order they lie in memory."""
    array = np.arange(12, dtype=np.float32).reshape(3, 2, 2)
    expected = hashlib.sha256(array.tobytes()).hexdigest()
    for given in (array, np.asfortranarray(array)):
        taken = features_from_columns(columns(features=given), pooling="mean", with_labels=False)
        assert taken.origin.sha256 == expected
        assert (taken.origin.shape, taken.origin.dtype, taken.origin.pooling) == (
            (3, 2, 2),
            "float32",
            "mean",
        )


def test_blocks_change_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """Read trial by trial, features and hash are the same as at once."""
    whole = features_from_columns(columns(), with_labels=False)
    monkeypatch.setattr(features, "BLOCK_BYTES", 1)
    blocks = features_from_columns(columns(), with_labels=False)
    assert blocks.values.tolist() == whole.values.tolist()
    assert blocks.origin == whole.origin


@pytest.mark.parametrize(
    ("dtype", "kept"),
    [
        (np.float16, np.float32),
        (np.float32, np.float32),
        (np.uint8, np.float32),
        (np.float64, np.float64),
        (np.int64, np.float64),
    ],
)
def test_numbers_keep_their_precision(dtype: type, kept: type) -> None:
    """Single precision stays, which halves the memory; what would lose digits is kept in double."""
    taken = features_from_columns(columns(features=np.ones((3, 2), dtype)), with_labels=False)
    assert taken.values.dtype == kept


def broken() -> Iterator[tuple[dict[str, Any], str]]:
    ones = np.ones((3, 2))
    yield {"features": ones}, "lacks trial_id, the trial of each row; found 'features'"
    yield {"trial_id": IDS, "x": [1, 2, 3]}, "lacks features; found 'trial_id', 'x'"
    yield columns(trial_id=IDS[:2]), r"trial_id has the shape \(2,\) and the features \(3, 2\)"
    yield columns(trial_id=["a", "b", "a"]), "trial 'a' has two rows"
    yield columns(trial_id=[1, 2, 3]), r"trial_id of row 0 \(from 0\) is '1'; a text is needed"
    yield columns(pair_id=["p", "", "q"]), r"pair_id of row 1 \(from 0\) is ''; a text is needed"
    yield columns(label=[0, 1, 2]), r"the label of trial 'c' is '2'; it must be 0 \(NO\) or 1 \(YES\)"
    yield columns(label=[0.0, np.nan, 1.0]), "the label of trial 'b' is 'nan'"
    yield columns(features=ones.astype(str)), "features are of type <U32; numbers are needed"
    yield columns(features=ones.astype(complex)), "features are of type complex128"
    yield columns(features=np.ones((3, 0))), r"the features are empty, their shape is \(3, 0\)"
    yield columns(features=np.empty((0, 2)), trial_id=IDS[:0]), "the features are empty"
    yield columns(features=np.array([[1.0], [2.0, 3.0], [4.0]], object)), "trials have different numbers"
    yield (
        columns(features=np.array([[1, 2], [np.nan, np.inf], [0, 1]])),
        "2 of the 2 features of trial 'b' are NaN, infinite or absurdly large",
    )
    yield columns(features=np.full((3, 2), 1e200)), "2 of the 2 features of trial 'a' are NaN"


@pytest.mark.parametrize(("given", "message"), [*broken()])
def test_broken_columns_are_refused(given: dict[str, Any], message: str) -> None:
    """Each fault is named with the file and the trial, and nothing is guessed."""
    with pytest.raises(SourceError, match=rf"^mine: {message}"):
        features_from_columns(given, name="mine", with_labels=True)


def test_stated_property_stands_for_a_column() -> None:
    """A property that is given beside the file counts for all its trials."""
    taken = features_from_columns(columns(), property_name="Mass", with_labels=False)
    assert taken.properties == ("Mass",) * 3


def test_bytes_are_texts() -> None:
    """Ids in bytes, as HDF5 tools write them, are read as texts."""
    taken = features_from_columns(columns(trial_id=np.array([b"a", b"b", b"c"])), with_labels=False)
    assert taken.trial_ids == ("a", "b", "c")
