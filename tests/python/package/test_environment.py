"""What surrounds the package: subinterpreters, flags of the processor, symbols of the module."""

from __future__ import annotations

import shutil
import subprocess
import sys
import warnings

import pytest

from curvewise import _core, _environment

FLUSH_TO_ZERO = 0x8040  # flush to zero, and denormals are zero, in the MXCSR register


def test_a_subinterpreter_is_refused():
    """The compiled module would hang there."""
    code = """
try:
    import _interpreters as interpreters
except ImportError:
    import _xxsubinterpreters as interpreters
inside = '''
try:
    import curvewise
except ImportError as error:
    print(error, flush=True)
'''
legacy = ["legacy"] if hasattr(interpreters, "new_config") else []
interpreters.run_string(interpreters.create(*legacy), inside)
"""
    run = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=False
    )
    assert run.stdout.startswith("curvewise does not work in a subinterpreter"), run.stderr


@pytest.mark.skipif(
    shutil.which("cc") is None, reason="there is no C compiler to build a library that sets flags"
)
def test_arithmetic_without_subnormals_is_said(tmp_path):
    source = tmp_path / "flags.c"
    source.write_text(
        "#if defined(__x86_64__)\n#include <xmmintrin.h>\n"
        f"int flush(void) {{ _mm_setcsr(_mm_getcsr() | {FLUSH_TO_ZERO}); return 1; }}\n"
        "#elif defined(__aarch64__)\n"
        'int flush(void) { __asm__ volatile("msr fpcr, %0" ::"r"(1UL << 24)); return 1; }\n'
        "#else\nint flush(void) { return 0; }\n#endif\n"
    )
    library = tmp_path / "flags.so"
    subprocess.run(["cc", "-shared", "-fPIC", "-o", library, source], check=True)
    code = (
        "import ctypes, sys, warnings\n"
        f"if not ctypes.CDLL({str(library)!r}).flush(): sys.exit(3)\n"
        "warnings.simplefilter('error')\n"
        "import curvewise\n"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    if run.returncode == 3:
        pytest.skip("nobody knows here how this processor's flags are set")
    assert "RuntimeWarning: this thread's arithmetic flushes numbers below" in run.stderr


def test_usual_arithmetic_is_silent():
    assert not _environment.flushes_subnormals()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        _environment.check()


@pytest.mark.skipif(shutil.which("nm") is None, reason="nm lists the symbols")
@pytest.mark.skipif(sys.platform != "linux", reason="of ELF modules")
def test_the_module_exports_its_init_function_alone():
    """Weak symbols of libstdc++, exported, may be taken for those of another module."""
    listing = subprocess.run(
        ["nm", "-D", "--defined-only", _core.__file__], capture_output=True, text=True, check=True
    )
    assert [line.split()[-1] for line in listing.stdout.splitlines()] == ["PyInit__core"]
