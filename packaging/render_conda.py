# SPDX-License-Identifier: Apache-2.0
"""render_conda.py RECIPE: rattler-build reads the recipe and renders it for Linux, on x86-64 and aarch64, with three versions of
Python.

py-rattler-build, from PyPI, is rattler-build itself. So a wrong field, function or requirement ends the script. Nothing is built.
"""
import sys

import rattler_build
from rattler_build.tool_config import PlatformConfig

VARIANTS = """
python: ["3.11.* *_cpython", "3.12.* *_cpython", "3.13.* *_cp313"]
c_compiler: [gcc]
cxx_compiler: [gxx]
c_compiler_version: ["13"]
cxx_compiler_version: ["13"]
c_stdlib: [sysroot]
c_stdlib_version: ["2.28"]
"""

recipe = rattler_build.Stage0Recipe.from_file(sys.argv[1])
for platform in ("linux-64", "linux-aarch64"):
    config = rattler_build.RenderConfig(platform=PlatformConfig(target_platform=platform))
    packages = [variant.recipe for variant in recipe.render(rattler_build.VariantConfig.from_yaml(VARIANTS), config)]
    names = sorted(name for name, _ in {(package.package.name, package.build.string) for package in packages})
    for package in packages:
        print(platform, package.package.name, package.package.version, package.build.string)
        if not package.to_dict().get("tests"):
            sys.exit(f"render_conda.py: {package.package.name} has no tests")
    if names != ["libriis", "riis", "riis", "riis"]:
        sys.exit(f"render_conda.py: for {platform} the recipe makes {names}, not libriis once and riis for each Python")
