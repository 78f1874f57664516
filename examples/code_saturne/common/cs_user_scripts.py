# SPDX-License-Identifier: Apache-2.0
# Tells code_saturne the mesh, the checkpoint for a restart, and where riis is installed: in the folder RIIS_PREFIX.
import os
import subprocess


def riis(*words):
    """Returns the flags that pkg-config prints."""
    path = os.path.join(os.environ["RIIS_PREFIX"], "lib", "pkgconfig")
    environment = dict(os.environ, PKG_CONFIG_PATH=path)
    return subprocess.check_output(("pkg-config",) + words, env=environment).decode().strip()


def define_domain_parameters(domain):
    domain.meshes = [os.environ.get("RUN_MESH", "root.msh")]
    domain.restart_input = os.environ.get("RUN_RESTART") or None
    domain.compile_cflags = riis("--cflags", "riis")
    domain.compile_fcflags = riis("--cflags", "riis-fortran")
    domain.compile_libs = riis("--libs", "riis-fortran") + " -Wl,-rpath," + os.path.join(os.environ["RIIS_PREFIX"], "lib")
