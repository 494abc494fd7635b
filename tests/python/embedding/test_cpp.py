"""The C++ tests, warnings as errors, with the library that the other tests of this folder use."""

from __future__ import annotations

import pytest
from programs import MARKS, OPTIONS, PURELIB, ROOT, build, compiler, output, tool

pytestmark = MARKS


# Whether what is behind the public headers is tested, too, and ctest's option: without the tests
# that have its label nightly, or with these alone. CI asks for the second at each run, by its name.
TESTS = [
    pytest.param("OFF", "--label-exclude", id="public"),
    pytest.param("ON", "--label-exclude", id="all", marks=pytest.mark.nightly),
    pytest.param("ON", "--label-regex", id="whole", marks=pytest.mark.nightly),
]


@pytest.mark.parametrize(("internals", "option"), TESTS)
def test_the_cpp_tests_pass(internals, option, prefix, tmp_path) -> None:
    compiler("c++", "g++", "clang++")
    build(
        ROOT,
        tmp_path,
        *OPTIONS,
        f"-DCMAKE_PREFIX_PATH={prefix('static')};{PURELIB.as_posix()}",  # that one first
        "-DCURVEWISE_BUILD_TESTS=ON",
        "-DCURVEWISE_TEST_INSTALLED=ON",
        f"-DCURVEWISE_TEST_INTERNALS={internals}",
    )
    options = [option, "nightly", "--output-on-failure", "--no-tests=error", "--parallel", "2"]
    output(tool("ctest"), "--test-dir", tmp_path, *options)
