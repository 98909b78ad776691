"""Folders that are written to, and what all results depend on."""

import os

import devlearn
import pytest
from devlearn import FileError, _files


@pytest.mark.parametrize(("commit", "different"), [("0a1b2c", 2), ("0a1b2c-dirty", 3)])
def test_what_results_depend_on_is_python_files_and_a_commit_or_what_was_built_of_none(
    tmp_path, monkeypatch, commit, different
):
    monkeypatch.setattr(_files._core, "commit", commit)
    measures = tmp_path / "paper" / "measures.py"
    measures.parent.mkdir()
    measures.write_text("one")
    extension = tmp_path / "_core.so"
    extension.write_bytes(b"one")
    monkeypatch.setattr(_files, "__file__", str(tmp_path / "_files.py"))
    monkeypatch.setattr(_files._core, "__file__", str(extension))
    prints = [_files.code_version(), _files.code_version()]
    assert prints[0] == prints[1]
    measures.write_text("another")
    prints.append(_files.code_version())
    extension.write_bytes(b"two")
    prints.append(_files.code_version())
    assert len(set(prints)) == different
    monkeypatch.setattr(_files._core, "commit", "another")
    assert _files.code_version() not in prints


def test_a_folder_is_made_with_those_above_it_and_may_be_there_already(tmp_path):
    for _ in range(2):
        assert _files.made_folder(str(tmp_path / "a" / "b")).is_dir()


def test_a_folder_that_takes_nothing_is_refused(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    for path in (tmp_path / "file", tmp_path / "file" / "below"):
        with pytest.raises(FileError) as caught:
            _files.made_folder(path)
        assert caught.value.file == str(path)
    monkeypatch.setattr(os, "access", lambda path, mode: not mode & os.W_OK)  # root may all
    with pytest.raises(devlearn.FileError, match="permission"):
        _files.made_folder(tmp_path)
