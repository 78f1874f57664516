# SPDX-License-Identifier: Apache-2.0
# The recipe for Spack, a file packages/riis/package.py of a package repository. packaging/recipes.py fills in the address and the
# checksum of a released archive.

from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import (
    SkipTest,
    cache_extra_test_sources,
    conflicts,
    depends_on,
    license,
    requires,
    run_after,
    variant,
    version,
    which,
    working_dir,
)


class Riis(CMakePackage):
    """Heart valves as resistive immersed implicit surfaces. In every time step riis marks the nodes of a mesh that lie near the
    leaflets of a moving valve, and a flow solver adds a resistance at these nodes."""

    homepage = "@HOMEPAGE@"
    url = "@URL@"

    license("Apache-2.0", checked_by="riis")

    version("1.0.0", sha256="@SHA256@")

    variant("shared", default=True, description="Build shared libraries")
    variant("fortran", default=True, description="Build the Fortran modules")
    variant("vtk", default=False, description="Build the component for files of meshes and surfaces, and for pictures")
    variant("program", default=False, when="+vtk", description="Build the program riis")
    variant("mpi", default=False, when="+program", description="Build the program with MPI")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("fortran", type="build", when="+fortran")
    depends_on("cmake@3.22:", type="build")
    depends_on("pkgconfig", type="test")

    depends_on("embree@3.13:4")
    depends_on("tbb")
    depends_on("vtk@9.1: +x", when="+vtk")
    depends_on("hdf5", when="+vtk")
    depends_on("libx11", when="+vtk")
    depends_on("cli11@2:", when="+program")
    depends_on("nlohmann-json@3.10:", when="+program")
    depends_on("mpi", when="+mpi")

    requires("target=x86_64:", "target=aarch64:", policy="one_of", msg="riis was tested on x86-64 and aarch64 only")
    conflicts("platform=darwin", msg="riis was tested on Linux only")
    conflicts("platform=windows", msg="riis was tested on Linux only")

    def cmake_args(self):
        return [
            self.define_from_variant("BUILD_SHARED_LIBS", "shared"),
            self.define_from_variant("RIIS_WITH_FORTRAN", "fortran"),
            self.define_from_variant("RIIS_WITH_VTK", "vtk"),
            self.define_from_variant("RIIS_BUILD_PROGRAM", "program"),
            self.define_from_variant("RIIS_PROGRAM_MPI", "mpi"),
            self.define("RIIS_BUILD_TESTS", False),
            self.define("RIIS_BUILD_BENCH", False),
        ]

    @run_after("install")
    def keep_examples(self):
        cache_extra_test_sources(self, "examples")

    def _mark(self, compiler, source):
        """Builds an example against the installed library and runs it. It marks 19,683 nodes."""
        pkg_config = which("pkg-config", required=True)
        name = "riis-fortran" if source.endswith(".f90") else "riis"
        with working_dir(self.test_suite.current_test_cache_dir.examples):
            flags = pkg_config("--cflags", "--libs", name, output=str).split()
            which(compiler, required=True)(source, *flags, f"-Wl,-rpath,{self.prefix.lib}", "-lm", "-o", "first_marking")
            answer = which("./first_marking", required=True)(output=str)
        assert "19683 nodes, marked: " in answer

    def test_c(self):
        """A C program links riis and marks a mesh"""
        self._mark(self.compiler.cc, "first_marking.c")

    def test_cxx(self):
        """A C++ program links riis and marks a mesh"""
        self._mark(self.compiler.cxx, "first_marking.cpp")

    def test_fortran(self):
        """A Fortran program uses the module riis and marks a mesh"""
        if self.spec.satisfies("~fortran"):
            raise SkipTest("riis was built without its Fortran modules")
        self._mark(self.compiler.fc, "first_marking.f90")
