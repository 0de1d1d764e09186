import os

from spack_repo.builtin.build_systems.cmake import CMakePackage, generator

from spack.package import *


class Kds(CMakePackage):
    """Kinetic data structures for deforming necklaces: the program and the C++20 library."""

    homepage = "https://github.com/FILL_OWNER/kds"
    url = "https://github.com/FILL_OWNER/kds/archive/refs/tags/v0.1.0.tar.gz"
    maintainers("FILL_ACCOUNT")
    license("GPL-3.0-or-later")

    version("0.1.0", sha256="FILL_SHA256")

    variant("any_processor", default=False, description="Serve processors without AVX2, too")

    generator("ninja")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("eigen")
    depends_on("cgal@5.5:")
    depends_on("boost+math")
    depends_on("gmp+cxx")
    depends_on("flint@3:")  # which contains Arb
    depends_on("mpfr")
    depends_on("gemmi@0.5:")
    depends_on("zlib-api")
    depends_on("netcdf-c")
    depends_on("fmt")
    depends_on("cli11")
    depends_on("nlohmann-json")
    conflicts("%gcc@:11")
    conflicts("%clang@:15")

    def cmake_args(self):
        return [self.define_from_variant("KDS_ANY_PROCESSOR", "any_processor")]

    @run_after("install")
    @on_package_attributes(run_tests=True)
    def check_install(self):
        os.environ["PATH"] = f"{self.prefix.bin}:{os.environ['PATH']}"
        os.environ["CMAKE_PREFIX_PATH"] = f"{self.prefix}:{os.environ.get('CMAKE_PREFIX_PATH', '')}"
        Executable(os.path.join(self.stage.source_path, "packaging", "check"))("program", "library")
