"""pip install app/python: builds the library and the module by CMake, and puts both into one wheel."""
import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCES = pathlib.Path(__file__).resolve().parents[2]
VERSION = re.search(r"VERSION ([0-9.]+)", (SOURCES / "CMakeLists.txt").read_text().split("project(", 1)[1]).group(1)


class ByCMake(build_ext):
    def build_extension(self, extension):
        place = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve()
        build = pathlib.Path(self.build_temp).resolve()
        subprocess.run(["cmake", "-S", SOURCES, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DCAREEN_PYTHON=ON", "-DCAREEN_UNITY=ON", "-DCAREEN_TESTS=OFF", f"-DPython_EXECUTABLE={sys.executable}",
                        "-DCMAKE_BUILD_WITH_INSTALL_RPATH=ON"], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "careen_python"], check=True)
        place.parent.mkdir(parents=True, exist_ok=True)
        module = next((build / "app/python").glob("careen*.so"))
        self.copy_file(str(module), str(place))
        library = (build / "engine/library/libcareen.so.0").resolve()
        self.copy_file(str(library), str(place.parent / "libcareen.so.0"))


setup(version=VERSION, ext_modules=[Extension("careen", [])], cmdclass={"build_ext": ByCMake},
      packages=["careen-stubs"], package_data={"careen-stubs": ["*.pyi"]})
