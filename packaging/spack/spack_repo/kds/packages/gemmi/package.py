from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Gemmi(CMakePackage):
    """Library of macromolecular crystallography, with a parser of PDB and mmCIF. It brings PEGTL along."""

    homepage = "https://project-gemmi.github.io"
    url = "https://github.com/project-gemmi/gemmi/archive/refs/tags/v0.6.7.tar.gz"
    license("MPL-2.0")

    version("0.6.7", sha256="FILL_GEMMI_SHA256")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("zlib-api")
