"""What docs/python.md shows runs as it stands there."""

import re

import pytest
from conftest import SOURCE


def test_the_code_of_the_page_runs(program, tmp_path, monkeypatch):
    pytest.importorskip("pandas")
    page = (SOURCE / "docs" / "python.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", page, re.S | re.M)
    assert len(blocks) >= 3
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in blocks:
        exec(compile(block, "docs/python.md", "exec"), names)  # noqa: S102
    assert names["found"].status == "feasible"
    assert names["forces"].fx_n.shape == (4, 200)


def test_every_public_name_is_documented_and_in_the_stubs():
    import ast

    import regoplan

    stub = ast.parse((SOURCE / "python/regoplan/__init__.pyi").read_text(encoding="utf-8"))
    declared = {node.name: node for node in stub.body
                if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and node.name[0] != "_"}
    declared["STATUS"] = None
    assert set(declared) == set(regoplan.__all__)
    for name in regoplan.__all__:
        thing = getattr(regoplan, name)
        if name == "STATUS":
            continue
        assert thing.__doc__, name
        if isinstance(thing, type):
            members = {node.name for node in declared[name].body
                       if isinstance(node, ast.FunctionDef)}
            public = {member for member, value in vars(thing).items()
                      if callable(getattr(value, "__func__", value)) and member[0] != "_"}
            assert public <= members, (name, public - members)
            assert all(getattr(thing, member).__doc__ for member in public), name
