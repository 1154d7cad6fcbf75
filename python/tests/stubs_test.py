# SPDX-License-Identifier: Apache-2.0
"""The type stubs say what the module is: every public name and signature, and docstrings for all of them."""
import ast
import inspect
import pathlib

import pytest

import patchproof
from patchproof import _patchproof

PACKAGE = pathlib.Path(patchproof.__file__).parent
STUB = ast.parse((PACKAGE / "_patchproof.pyi").read_text(encoding="utf-8"))


def public(names):
    return {name for name in names if not name.startswith("_")}


def functions(body):
    """{name: [overloads]} of the functions among statements."""
    out = {}
    for node in body:
        if isinstance(node, ast.FunctionDef):
            out.setdefault(node.name, []).append(node)
    return out


def stub_parameters(node):
    """(name, kind, default as text or None) of each parameter."""
    arguments, out = node.args, []
    defaults = [None] * (len(arguments.args) - len(arguments.defaults)) + arguments.defaults
    out += [(a.arg, "any", d) for a, d in zip(arguments.args, defaults)]
    out += [(a.arg, "named", d) for a, d in zip(arguments.kwonlyargs, arguments.kw_defaults)]
    return [(name, kind, None if d is None else ast.unparse(d)) for name, kind, d in out]


def real_parameters(function):
    kinds = {inspect.Parameter.POSITIONAL_OR_KEYWORD: "any", inspect.Parameter.KEYWORD_ONLY: "named",
             inspect.Parameter.POSITIONAL_ONLY: "any"}
    return [(p.name, kinds[p.kind], None if p.default is p.empty else repr(p.default))
            for p in inspect.signature(function).parameters.values()]


def is_property(nodes):
    return any(isinstance(d, ast.Name) and d.id == "property" for d in nodes[0].decorator_list)


CLASSES = {node.name: node for node in STUB.body if isinstance(node, ast.ClassDef)}


def test_the_stub_has_every_name():
    names = set(CLASSES) | set(functions(STUB.body))
    assert public(names) == public(vars(_patchproof))
    assert any(isinstance(n, ast.AnnAssign) and n.target.id == "__version__" for n in STUB.body)
    assert (PACKAGE / "py.typed").exists()


@pytest.mark.parametrize("name", CLASSES)
def test_classes_have_what_the_stub_says(name):
    members, real = functions(CLASSES[name].body), getattr(_patchproof, name)
    assert public(members) == public(vars(real))
    for member, nodes in members.items():
        value = inspect.getattr_static(real, member, None)
        assert isinstance(value, property) == is_property(nodes), member
        if member == "__init__":
            assert stub_parameters(nodes[0])[1:] == real_parameters(real)
        elif not isinstance(value, property) and not member.startswith("__"):
            check_overloads(member, nodes, value)


def check_overloads(name, nodes, function):
    """Each overload has the names and order of the real parameters; a single one also their kinds and defaults."""
    real = real_parameters(function)
    for node in nodes:
        declared = stub_parameters(node)
        assert [p[:2] for p in declared if p[0] != "self"] == [p[:2] for p in real if p[0] != "self"] or len(nodes) > 1, name
        assert [p[0] for p in declared] == [p[0] for p in real], name
        for (_, _, stub), (_, _, default) in zip(declared, real):
            narrowed = len(nodes) > 1 and (stub is None or (stub == "..." and default is not None))
            assert stub == default or narrowed, (name, stub, default)


@pytest.mark.parametrize("name", functions(STUB.body))
def test_functions_have_what_the_stub_says(name):
    check_overloads(name, functions(STUB.body)[name], getattr(_patchproof, name))


def test_calls_agree_with_their_signatures():
    """The signatures in docstrings are texts of ours: each function takes what its own says."""
    patch = patchproof.Model([patchproof.PatchData([[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0.0]]])]).patches[0]
    bound = inspect.signature(type(patch).evaluate).bind(patch, (0.5, 0.5))
    bound.apply_defaults()
    assert type(patch).evaluate(*bound.args, **bound.kwargs).shape == (3,)
    for kind in CLASSES:
        for name, member in vars(getattr(_patchproof, kind)).items():
            if callable(member) and not name.startswith("_"):
                with pytest.raises(TypeError, match="incompatible function arguments"):
                    member(object(), **{p: None for p in inspect.signature(member).parameters if p != "self"}, no_such_word=1)
    for name in functions(STUB.body):
        names = inspect.signature(getattr(_patchproof, name)).parameters
        with pytest.raises(TypeError, match="incompatible function arguments"):
            getattr(_patchproof, name)(**{p: None for p in names}, no_such_word=1)


def test_everything_is_explained():
    for name in patchproof.__all__:
        thing = getattr(patchproof, name)
        assert inspect.getdoc(thing), name
        if inspect.isclass(thing) and thing.__module__.endswith("_patchproof"):
            for member in public(vars(thing)):
                assert inspect.getdoc(inspect.getattr_static(thing, member)), f"{name}.{member}"
    for name in ("evaluate", "evaluate_grid", "evaluate_bounded", "enclose", "evaluate_rounded"):
        assert "3)" in getattr(patchproof.Patch, name).__doc__, "shapes belong into docstrings"
    assert patchproof.Patch.evaluate.__doc__.count("unit") >= 1 and "degrees" in patchproof.certify.__doc__


def test_the_package_lists_what_it_exports():
    assert set(patchproof.__all__) == public(n for n, v in vars(patchproof).items() if not inspect.ismodule(v))
    assert patchproof.__version__.count(".") == 2
    for name in patchproof.__all__:
        assert hasattr(patchproof, name)
