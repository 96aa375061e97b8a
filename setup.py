"""The compiled part of the Python package: what `cmake --preset python` makes. `pip install . --no-build-isolation`
needs no network; the packages that it needs are installed by `tools/setup.sh --python`."""
import pathlib
import subprocess

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    def build_extension(self, ext: Extension) -> None:
        folder = ROOT / "build" / "release"  # of the preset `python`: linked from the program's objects
        subprocess.run(["cmake", "--preset", "python"], cwd=ROOT, check=True)
        subprocess.run(["cmake", "--build", str(folder), "--target", "ambrig_python", "ambrig_fmu_library"],
                       cwd=ROOT, check=True)
        (made,) = (folder / "python" / "ambrig").glob("_core*.so")
        target = pathlib.Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(made), str(target))
        self.copy_file(str(folder / "ambrig_fmu.so"), str(target.parent / "ambrig_fmu.so"))  # goes into FMUs


setup(ext_modules=[Extension("ambrig._core", sources=[])], cmdclass={"build_ext": CMakeBuild})
