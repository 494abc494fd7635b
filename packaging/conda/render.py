"""Render recipe.yaml as rattler-build does, for every platform, and print what it then asks for.

Rendering checks the recipe's syntax and fills in compilers and versions. It is less than building:
that needs conda's channels. The version comes from the environment, CURVEWISE_VERSION.
"""

from __future__ import annotations

import os
from pathlib import Path

from rattler_build import PlatformConfig, RenderConfig, Stage0Recipe, VariantConfig

PLATFORMS = ("linux-64", "linux-aarch64", "osx-64", "osx-arm64", "win-64")
PYTHONS = ("3.10", "3.11", "3.12", "3.13", "3.14")
# What conda-forge's pinning files say beside the versions of Python.
VARIANTS = {"python": list(PYTHONS), "c_stdlib": ["sysroot"]}


def main() -> None:
    """Print each platform's requirements; fail where a Python or the version is missing."""
    recipe = Stage0Recipe.from_file(Path(__file__).with_name("recipe.yaml"))
    version = os.environ["CURVEWISE_VERSION"]
    for platform in PLATFORMS:
        config = RenderConfig(platform=PlatformConfig(target_platform=platform))
        rendered = [found.recipe for found in recipe.render(VariantConfig(VARIANTS), config)]
        if len(rendered) != len(PYTHONS) or {str(r.package.version) for r in rendered} != {version}:
            raise SystemExit(f"{platform}: {len(rendered)} packages, not {len(PYTHONS)}")
        needs = rendered[0].requirements.to_dict()
        for where, packages in needs.items():
            print(f"{platform} {where}: {', '.join(packages)}")


if __name__ == "__main__":
    main()
