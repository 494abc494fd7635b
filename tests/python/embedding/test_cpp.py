"""The C++ tests, warnings as errors, with the library that the other tests of this folder use."""

from __future__ import annotations

import pytest
from programs import MARKS, OPTIONS, PURELIB, ROOT, build, compiler, output, tool

pytestmark = MARKS


# ctest's options: without the tests that have its label nightly, and with these alone. CI asks for
# the first at each run, by its name: most of a minute and a half is the compiler's.
TESTS = [
    pytest.param("--label-exclude", id="all"),
    pytest.param("--label-regex", id="whole"),
]


@pytest.mark.parametrize("option", TESTS)
@pytest.mark.nightly
def test_the_cpp_tests_pass(option, prefix, tmp_path) -> None:
    compiler("c++", "g++", "clang++")
    build(
        ROOT,
        tmp_path,
        *OPTIONS,
        f"-DCMAKE_PREFIX_PATH={prefix('static')};{PURELIB.as_posix()}",  # that one first
        "-DCURVEWISE_BUILD_TESTS=ON",
        "-DCURVEWISE_TEST_INSTALLED=ON",
    )
    options = [option, "nightly", "--output-on-failure", "--no-tests=error", "--parallel", "2"]
    output(tool("ctest"), "--test-dir", tmp_path, *options)
