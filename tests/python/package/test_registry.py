"""The lists of measures in all layers are consistent.

Names, choices, signatures and defaults are defined once in each layer: in curvewise._options for
Python and the reference, next to the enumerators for C++, in c_options.h for C, in curvewise.f90
for Fortran. A change of one without the others fails here.
"""

from __future__ import annotations

import ast
import dataclasses
import inspect
import re
import subprocess
import sys
from pathlib import Path
from typing import Any, get_args, get_type_hints

import numpy as np
import pytest

import curvewise
from curvewise import _core, _options, measures, plotting, reference
from curvewise.materials import MATERIALS
from curvewise.materials.options import material_options
from curvewise.measures.edit_distances import EditDistance
from curvewise.measures.registry import MEASURES, PRESETS, WARPINGS, MeasureName
from curvewise.solvers.cards import FORMATS

ROOT = next(folder for folder in Path(__file__).parents if (folder / "pyproject.toml").is_file())
C_HEADER = ROOT / "cpp" / "include" / "curvewise" / "c_options.h"
FORTRAN = ROOT / "cpp" / "fortran" / "curvewise.f90"
STUB = ROOT / "python" / "curvewise" / "_core.pyi"

# By option, the alias that lists its choices, and what C and Fortran put before a choice.
CHOICES = {
    "metric": (_options.Metric, ""),
    "step_pattern": (_options.StepPatternName, ""),
    "spacing": (_options.Spacing, "spacing_"),
    "crossing": (_options.Crossing, ""),
    "scale": (_options.LengthScale, "scale_"),
}

# C and Fortran have the others.
OF_CPP_AND_PYTHON = ("hausdorff", "hausdorff_continuous", *get_args(EditDistance))
# A measure's options that no other measure has, or that differ from the others'.
OWN_DEFAULTS = {
    "erp": ("gap",),
    "edr": ("epsilon",),
    "lcss": ("epsilon",),
    "msm": ("cost",),
    "twe": ("stiffness", "penalty"),
    "wdtw": ("metric", "steepness"),
}

# The reference computes the plain table, in one thread.
NOT_OF_THE_REFERENCE = ("workers", "prune", "cutoff", "missing")
# What Python does before the compiled library sees a curve.
OF_PYTHON = ("missing", "closed", "dependent")
CLOSABLE = ("dtw", "frechet", "frechet_continuous")


def keyword_defaults(function: Any) -> dict[str, Any]:
    parameters = inspect.signature(function).parameters.values()
    return {p.name: p.default for p in parameters if p.kind is p.KEYWORD_ONLY}


def families() -> list[str]:
    """Return the functions of two curves and options, e.g. area and area_quads."""
    return [name for name in reference.__all__ if positional(getattr(reference, name)) == "PQ"]


def positional(function: Any) -> str:
    parameters = inspect.signature(function).parameters.values()
    return "".join(p.name for p in parameters if p.kind is p.POSITIONAL_OR_KEYWORD)


def without_bounds(name: str, options: dict[str, Any]) -> dict[str, Any]:
    """Return the options that the library has, too, without those that change the type of the
    result.
    """
    of_python = {"bounds", *OF_PYTHON} - set(_core.measures().get(name, ()))
    return {key: value for key, value in options.items() if key not in of_python}


def measure_of(function: str) -> str:
    """Return the measure a function belongs to: the longest one that its name begins with."""
    return max((name for name in MEASURES if function.startswith(name)), key=len, default="")


def test_every_layer_has_the_same_measures_in_the_same_order() -> None:
    names = list(MEASURES)
    assert list(_core.measures()) == names
    assert [name for one in get_args(MeasureName) for name in get_args(one)] == names
    assert curvewise.available_measures() == sorted(names)
    assert c_choices("measure", "") == names[: -len(OF_CPP_AND_PYTHON)]
    assert c_choices("preset", "") == fortran_choices("preset_", list(PRESETS)) == list(PRESETS)
    assert fortran_choices("measure_", names[: -len(OF_CPP_AND_PYTHON)]) == c_choices("measure", "")
    assert tuple(names[-len(OF_CPP_AND_PYTHON) :]) == OF_CPP_AND_PYTHON


@pytest.mark.parametrize("option", CHOICES)
def test_every_layer_has_the_same_choices_in_the_same_order(option: str) -> None:
    alias, prefix = CHOICES[option]
    choices = list(get_args(alias))
    assert _core.choices().keys() == CHOICES.keys()
    assert list(_core.choices()[option]) == choices
    c_enum = {"scale": "length_scale"}.get(option, option)
    in_c = c_choices(c_enum, "spacing_" if option == "spacing" else "")
    assert in_c == [choice.lower() for choice in choices]
    named = choices[:2] if option == "step_pattern" else choices
    assert fortran_choices(prefix, named) == named


def test_python_has_every_material_of_the_library() -> None:
    """C and Fortran name a material by a text, which reads the library's list."""
    known = _core.materials()
    assert list(MATERIALS) == list(known)
    for name, kind in MATERIALS.items():
        defaults = {one.name: one.default for one in dataclasses.fields(kind)}
        assert (kind.name, defaults) == (name, known[name])
        assert {kind.yield_stress, *kind.isotropic} - {""} <= set(kind().names)
        for option in material_options([kind]).values():
            for choice in option.choices:
                assert kind(**{option.name: choice}).names
    for form in FORMATS.values():
        assert set(form.laws) <= set(known)
        for name, law in form.laws.items():
            options = material_options([MATERIALS[name]])
            for option, choices in law.choices.items():
                assert set(choices) <= set(options[option].choices)


@pytest.mark.parametrize("name", MEASURES)
def test_every_layer_has_the_same_options_and_defaults(name: str) -> None:
    options = without_bounds(name, keyword_defaults(MEASURES[name].function))
    assert list(options.items()) == list(_core.measures()[name].items())
    for option, default in options.items():
        if option not in OWN_DEFAULTS.get(name, ()):
            assert default is getattr(_options.Default, option, default)
        if option in CHOICES:
            assert default in get_args(CHOICES[option][0])
    plain = {key: value for key, value in options.items() if key not in NOT_OF_THE_REFERENCE}
    assert without_bounds(name, keyword_defaults(getattr(reference, name))) == plain
    if name in OF_CPP_AND_PYTHON:
        return
    expected = {
        option: written(option, default) for option, default in options.items() if option != "relax"
    }
    # In languages without unions, each kind of value has a separate option.
    if name == "dtw":
        expected["window_fraction"] = "0"
        for end in ("p_begin", "p_end", "q_begin", "q_end"):
            expected[f"relax_{end}"] = "0"
    if name == "pcm":
        expected["continuous"] = "0"
    if name in CLOSABLE:  # in C++ a separate function
        expected["closed"] = "0"
    assert c_defaults(name) == expected
    assert fortran_defaults(name) == expected


@pytest.mark.parametrize("function", families())
def test_functions_of_a_measure_take_its_options(function: str) -> None:
    measure = measure_of(function)
    options = keyword_defaults(getattr(measures, function))
    of_python = {*OF_PYTHON} - set(_core.measures().get(measure, ()))
    for option in of_python:
        options.pop(option, None)
    of_measure = keyword_defaults(MEASURES[measure].function) if measure else {}
    if function.startswith("soft_dtw"):  # a loss, not a distance, and in none of their lists
        of_measure = keyword_defaults(measures.soft_dtw)
    if function.startswith("lb_"):  # bounds of dtw
        of_measure = keyword_defaults(measures.dtw)
    assert options.items() <= of_measure.items()
    plain = {key: value for key, value in options.items() if key not in NOT_OF_THE_REFERENCE}
    of_reference = keyword_defaults(getattr(reference, function))
    assert {o: v for o, v in of_reference.items() if o not in of_python} == plain
    options = without_bounds(measure, options)
    if not measure or function == measure:
        return
    P = np.array([(0.0, 0.0), (1.0, 2.0), (3.0, 1.0)])
    Q = P + 1.0
    compiled = getattr(_core, function)
    assert repr(compiled(P, Q, {})) == repr(compiled(P, Q, options))
    with pytest.raises(TypeError, match=rf"^{measure} has no option 'foo'; it has "):
        compiled(P, Q, {"foo": 1})


@pytest.mark.parametrize("name", MEASURES)
def test_a_measure_hands_on_its_options_in_their_order(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    function = MEASURES[name].function
    given = {option: object() for option in _core.measures()[name]}
    monkeypatch.setitem(
        function.__globals__, f"compiled_{name}", lambda P, Q, options: ("taken", P, Q, options)
    )
    assert function("P", "Q", **given) == ("taken", "P", "Q", tuple(given.values()))


@pytest.mark.parametrize("name", MEASURES)
def test_a_measure_wants_every_option(name: str) -> None:
    P = np.array([(0.0, 0.0), (1.0, 2.0), (3.0, 1.0)])
    count = len(_core.measures()[name])
    with pytest.raises(TypeError, match=rf"^there are 0 values for {count} options$"):
        getattr(_core, name)(P, P, ())


@pytest.mark.parametrize("function", reference.__all__)
def test_annotations_of_measure_and_reference_agree(function: str) -> None:
    ours, theirs = (get_type_hints(getattr(m, function)) for m in (measures, reference))
    for option in NOT_OF_THE_REFERENCE:
        ours.pop(option, None)
    assert ours == theirs


def test_the_stub_has_what_the_module_has() -> None:
    stub = ast.parse(STUB.read_text(encoding="utf-8"))
    declared = {node.name for node in stub.body if isinstance(node, ast.FunctionDef | ast.ClassDef)}
    declared |= {"earth_radius"}
    compiled = {name for name in vars(_core) if not name.startswith("_")}
    assert declared - {"BuildInfo", "__getattr__"} == compiled - MEASURES.keys()
    functions = [node for node in stub.body if isinstance(node, ast.FunctionDef)]
    with_options = {node.name for node in functions if takes_a_pair_and_options(node)}
    bounds = {"frechet_continuous_bounds"}  # in Python an option of frechet_continuous
    # Options of these and their paths.
    closed = {f"closed_{name}{end}" for name in CLOSABLE for end in ("", "_path")}
    closed |= {f"closed_{name}" for name in bounds}
    takes_options = {name for name in measures.__all__ if measure_of(name)} - {"frechet_within"}
    others = bounds | closed | {"soft_dtw", "lb_improved", "lb_keogh", "lb_kim"}
    assert with_options == (takes_options | others) - MEASURES.keys()


def test_presets_have_a_condition_for_every_measure() -> None:
    assert tuple(PRESETS) == get_args(_options.Preset)
    for conditions in PRESETS.values():
        assert list(conditions) == list(MEASURES)
        for name, condition in conditions.items():
            assert condition.options.keys() <= _core.measures()[name].keys()
    assert all(condition == (False, {}) for condition in PRESETS["raw"].values())


@pytest.mark.parametrize("name", MEASURES)
def test_the_registry_tells_the_truth(name: str) -> None:
    info = MEASURES[name]
    assert info.name == name == info.function.__name__
    assert info.function is getattr(curvewise, name)
    assert callable(getattr(plotting, info.picture))
    assert _core.is_symmetric(name, {}) == info.symmetric
    solid = np.arange(12.0).reshape(4, 3)
    if info.planar:
        with pytest.raises(ValueError, match=f"{name} needs 2 coordinates, x and y"):
            info.function(solid, solid)
    else:
        assert info.function(solid, solid) == 0.0
    has_path = name in get_args(_options.WarpingName) or name == "frechet_continuous"
    assert (f"{name}_path" in measures.__all__) == has_path
    assert (f"{name}_residuals" in measures.__all__) == (info.residuals is not None)
    curves = [(1, 2), (2, 5), (4, 1)], [(1, 0), (2, 3), (4, 2)]
    if name == "edr":  # its threshold depends on the curves
        return
    scaled = info.function(*curvewise.normalize(*curves))
    assert (scaled == pytest.approx(info.function(*curves), rel=1e-12)) == info.scales_itself


def test_warpings_are_what_their_alias_lists() -> None:
    of_both = {*get_args(_options.WarpingName), *get_args(EditDistance)}
    assert WARPINGS.keys() == of_both


def test_every_default_has_an_option() -> None:
    defaults = {name for name in vars(_options.Default) if not name.startswith("_")}
    known = {option for options in _core.measures().values() for option in options}
    assert defaults <= known | {*OF_PYTHON}


@pytest.mark.parametrize("name", reference.__all__)
def test_the_reference_is_documented_as_the_measures_are(name: str) -> None:
    ours, theirs = (inspect.getdoc(getattr(m, name)) or "" for m in (measures, reference))
    assert ours.partition("\n")[0] == theirs.partition("\n")[0]
    for section in ("Parameters", "Returns", "Raises", "Notes", "Examples"):
        assert f"\n{section}\n---" in theirs
    for option in NOT_OF_THE_REFERENCE:
        assert option not in theirs
    assert "curvewise." not in theirs


def test_the_reference_imports_nothing_compiled() -> None:
    allowed = ("_options", "curves.", "measures.results", "measures.step_pattern")
    folder = ROOT / "python" / "curvewise" / "reference"
    for file in set(folder.glob("*.py")) - {folder / "__init__.py"}:  # which takes docstrings
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and node.level == 2:
                assert str(node.module).startswith(allowed), file.name


HEAVY = ("dask", "geopandas", "jax", "sklearn", "sktime", "torch")
LIGHT = [name for name in curvewise._LAZY if name not in HEAVY]


@pytest.mark.parametrize("names", [LIGHT, *([name] for name in curvewise._LAZY)], ids="-".join)
@pytest.mark.nightly(r"^\w+$")  # each in a separate process
def test_submodules_are_reachable_and_imported_late(names: list[str]) -> None:
    if names[0] in HEAVY:
        pytest.importorskip(names[0], reason=f'no {names[0]}: pip install "curvewise[{names[0]}]"')
    late = [f"curvewise.{module}" for module in curvewise._LAZY]
    assert len(LIGHT) == len(late) - len(HEAVY)
    code = (
        "import sys, curvewise\n"
        f"early = {{*{late}, 'matplotlib', 'scipy', *{HEAVY}}} & sys.modules.keys()\n"
        "assert not early, early\n"
        f"for name in {names}:\n"
        "    assert getattr(curvewise, name) is sys.modules[f'curvewise.{name}']\n"
        "assert {'calibration', 'compat', 'plotting', 'dtw'} <= set(dir(curvewise))\n"
        "assert not {'matplotlib', 'scipy'} & sys.modules.keys()\n"
    )
    if names[0] in HEAVY:
        code = code.replace("assert not {'matplotlib', 'scipy'} & sys.modules.keys()\n", "")
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize("name", [n for n in dir(curvewise) if isinstance(n, str)])
def test_a_shell_completes_public_names_alone(name: str) -> None:
    module = getattr(curvewise, name)
    if inspect.ismodule(module):
        assert dir(module) == sorted(module.__all__)
        assert not [public for public in dir(module) if public.startswith("_")]


def test_an_attribute_that_is_not_there_is_an_error() -> None:
    with pytest.raises(AttributeError, match="module 'curvewise' has no attribute 'no_such'"):
        _ = curvewise.no_such


def takes_a_pair_and_options(function: ast.FunctionDef) -> bool:
    return [argument.arg for argument in function.args.posonlyargs] == ["P", "Q", "options"]


def written(option: str, default: Any) -> str:
    """Return a default as a C or Fortran constant, in small letters and without a prefix."""
    if default is None:
        return {"p": "2", "window": "no_window", "cutoff": "huge_val", "radius": "6371008.8"}[
            option
        ]
    return str(int(default) if isinstance(default, bool) else default).removesuffix(".0")


def c_choices(enum: str, prefix: str) -> list[str]:
    text = C_HEADER.read_text(encoding="utf-8")
    body = re.search(rf"enum curvewise_{enum} {{(.*?)}}", text, re.DOTALL)
    assert body, enum
    assert "=" not in body[1]  # numbered from 0 on, as in C++
    names = re.findall(r"CURVEWISE_(\w+)", body[1])
    return [name.lower().removeprefix(prefix) for name in names]


def c_defaults(measure: str) -> dict[str, str]:
    text = re.sub(r"/\*.*?\*/", "", C_HEADER.read_text(encoding="utf-8"), flags=re.DOTALL)
    struct = re.search(rf"struct curvewise_{measure}_options {{(.*?)}}", text, re.DOTALL)
    values = re.search(rf"CURVEWISE_{measure.upper()}_DEFAULTS[\s\\]*{{(.*?)}}", text, re.DOTALL)
    assert struct, measure
    assert values, measure
    size, control, *members = re.findall(r"(\w+);", struct[1])
    assert (size, control) == ("size", "control")
    constants = [bare(value) for value in values[1].replace("\\\n", "").split(",")]
    assert constants[:2] == [f"sizeof({measure}_options)", "null"]
    return dict(zip(members, constants[2:], strict=True))


def fortran_choices(prefix: str, expected: list[str]) -> list[str]:
    """Return those of `expected` that have a constant, in the order of the constants' values."""
    values = dict(re.findall(r"(\w+) = (-?\d+)", FORTRAN.read_text(encoding="utf-8")))
    codes = {choice: values.get(prefix + choice) for choice in expected}
    assert sorted(codes.values(), key=str) == [str(i) for i in range(len(expected))], codes
    return sorted(codes, key=lambda choice: int(codes[choice] or 0))


def fortran_defaults(measure: str) -> dict[str, str]:
    text = re.sub(r"!.*", "", FORTRAN.read_text(encoding="utf-8"))
    body = re.search(rf"public :: {measure}_options\n(.*?)end type", text, re.DOTALL)
    assert body, measure
    return {name: bare(value) for name, value in re.findall(r":: (\w+) = (\S+)", body[1])}


def bare(constant: str) -> str:
    """Return a constant without what says whose it is."""
    name = constant.strip().lower().replace("curvewise_", "").removesuffix(".0")
    name = {".true.": "1", ".false.": "0"}.get(name, name)
    name = name.replace("huge(1.0_c_double)", "huge_val").removesuffix(
        "_c_double"
    )  # Fortran need not have an infinity
    return name.removeprefix("spacing_").removeprefix("scale_")
