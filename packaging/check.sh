#!/usr/bin/env bash
# What is asked of the packages before a release, as far as one machine can tell: the source
# distribution builds without a network and twice to the same bytes; the wheel is well-formed and
# works where there is neither compiler nor Eigen; cibuildwheel, conda's rattler-build, Debian's cmake
# and Conan accept what is meant for them. Needs git, Python >= 3.11, a C++17 compiler and PyPI; some
# fifteen minutes, nearly all of them the builds. What is packed is the last commit. Nothing outside a
# temporary folder is written, except for the packages where a folder for them is given:
#
#     packaging/check.sh [folder]
set -euo pipefail
cd "$(dirname "$0")/.."
packages=${1:+$(realpath -m "$1")}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

say() { printf '\n== %s\n' "$*"; }
fail() {
    echo "packaging: $*" >&2
    exit 1
}
sha() { sha256sum "$@" | cut -d' ' -f1; }

version=$(sed -n 's/.*version\[\] = "\(.*\)".*/\1/p' cpp/include/curvewise/version.hpp)
grep -q "^## $version" CHANGELOG.md || fail "CHANGELOG.md has no section $version"
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH PIP_DISABLE_PIP_VERSION_CHECK=1
export CCACHE_DISABLE=1 # A second build out of a cache would show nothing.

python3 -m venv "$work/tools"
tools=$work/tools/bin
"$tools/pip" install -q build twine check-wheel-contents abi3audit auditwheel cibuildwheel \
    py-rattler-build

say "curvewise $version: source distribution, twice"
for turn in 1 2; do
    mkdir "$work/source$turn"
    git archive HEAD | tar -x -C "$work/source$turn"
    "$tools/python" -m build -q --sdist -o "$work/sdist$turn" "$work/source$turn"
done
sdist=$work/sdist1/curvewise-$version.tar.gz
sha "$sdist"
[ "$(sha "$sdist")" = "$(sha "$work/sdist2/"*.tar.gz)" ] || fail "two sdists differ"

say "wheel from it, without a network, twice, in two folders"
mapfile -t requirements < <("$tools/python" - <<'PYTHON'
import tomllib
with open("pyproject.toml", "rb") as file:
    print(*tomllib.load(file)["build-system"]["requires"], "cmake>=3.21", "ninja", sep="\n")
PYTHON
)
"$tools/pip" download -q -d "$work/requirements" "${requirements[@]}"
offline=(unshare -rn)
"${offline[@]}" true 2>/dev/null || {
    echo "no unshare -n here: pip is told --no-index, and the network stays"
    offline=()
}
for turn in 1 2; do
    mkdir -p "$work/turn $turn" # a blank in its name, too
    TMPDIR="$work/turn $turn" "${offline[@]}" "$tools/pip" wheel -q --no-deps --no-cache-dir \
        --no-index --find-links "$work/requirements" -w "$work/wheel$turn" "$sdist"
done
wheel=$(echo "$work/wheel1/"*.whl)
sha256sum "$work"/wheel?/*.whl | sed "s|$work/||"
[ "$(sha "$wheel")" = "$(sha "$work/wheel2/"*.whl)" ] || fail "two wheels differ"

say "their contents"
"$tools/twine" check --strict "$sdist" "$wheel"
"$tools/check-wheel-contents" "$wheel"
case $wheel in
*-abi3-*) "$tools/abi3audit" --strict "$wheel" ;;
*) echo "no stable ABI is promised (pybind11 has none): nothing for abi3audit" ;;
esac
if [ "$(uname)" = Linux ]; then "$tools/auditwheel" show "$wheel"; fi
if unzip -p "$wheel" | grep -aF "$work" >/dev/null; then fail "the wheel names the folder it was built in"; fi

say "the wheel where there is no compiler: selfcheck, and the tests that cibuildwheel runs"
python3 -m venv "$work/user"
mapfile -t tested < <("$tools/python" - <<'PYTHON'
import tomllib
with open("pyproject.toml", "rb") as file:
    settings = tomllib.load(file)["tool"]["cibuildwheel"]
print(settings["test-command"], *settings["test-requires"], sep="\n")
PYTHON
)
"$work/user/bin/pip" install -q "$wheel" "${tested[@]:1}"
mkdir "$work/tests"
cp -r "$work/source1/pyproject.toml" "$work/source1/tests" "$work/tests"
(
    cd "$work/tests"
    alone() { env -i PATH="$work/user/bin" HOME="$work" LANG=C.UTF-8 "$@"; }
    for program in c++ g++ clang++ cc cmake ninja; do
        if alone "$BASH" -c "command -v $program"; then fail "$program is within reach"; fi
    done
    alone "$BASH" -c "${tested[0]}"
)

say "cibuildwheel's list"
for place in linux:x86_64 linux:aarch64 macos:x86_64 macos:arm64 windows:AMD64 pyodide:auto; do
    echo "$place" $("$tools/cibuildwheel" --platform "${place%:*}" --archs "${place#*:}" \
        --print-build-identifiers .)
done

say "conda's recipe, rendered"
CURVEWISE_VERSION=$version "$tools/python" packaging/conda/render.py

say "the C++ package, by the system's cmake"
PATH=/usr/local/bin:/usr/bin:/bin command -v cmake >/dev/null || {
    echo "no cmake outside of Python's folders: left out"
    exit 0
}
mkdir "$work/scratch"
sed -n '/<!-- file: main.cpp -->/,/^```$/p' docs/embedding.md | sed '1,2d;$d' >"$work/scratch/main.cpp"
sed -n '/<!-- file: find_package\/CMakeLists.txt -->/,/^```$/p' docs/embedding.md | sed '1,2d;$d' \
    >"$work/scratch/CMakeLists.txt"
(
    export PATH=/usr/local/bin:/usr/bin:/bin
    unset CCACHE_DISABLE
    cmake --version | head -n 1
    "$tools/pip" install -q cmeel-eigen # where the system has no Eigen
    eigen=$("$tools/python" -c "import sysconfig; print(sysconfig.get_path('purelib'))")
    cmake -S "$work/source1" -B "$work/library" -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$eigen"
    cmake --build "$work/library" --parallel 2
    cmake --install "$work/library" --prefix "$work/prefix"
    for from in "-DCMAKE_PREFIX_PATH=$work/prefix" \
        "-Dcurvewise_DIR=$("$work/user/bin/python" -m curvewise --cmakedir)"; do
        rm -rf "$work/scratch/build"
        cmake -S "$work/scratch" -B "$work/scratch/build" "$from"
        cmake --build "$work/scratch/build"
        "$work/scratch/build/tool"
    done

    say "the C++ package by Conan, static and shared"
    "$tools/pip" install -q conan
    export PATH="$tools:$PATH" CONAN_HOME="$work/conan" # with the Eigen of this Python
    conan profile detect
    printf 'include(default)\n[platform_requires]\neigen/3.4.0\n' >"$work/this-eigen"
    for shared in False True; do
        conan create "$work/source1/packaging/conan" -pr "$work/this-eigen" --no-remote \
            -s compiler.cppstd=17 -o "curvewise/*:shared=$shared"
    done
)

if [ -n "$packages" ]; then
    mkdir -p "$packages"
    cp "$sdist" "$wheel" "$packages"
    echo "packages: $packages"
fi
echo "packaging: all is well"
