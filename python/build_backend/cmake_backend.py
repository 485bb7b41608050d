"""A PEP 517 backend that builds the wheel of remodel with CMake. It needs nothing but Python, CMake and a compiler.

REMODEL_BUILD_DIRECTORY names a configured build directory to take the module from, instead of build/wheel, which is
configured when it is missing.
"""

import base64
import hashlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "python" / "remodel"


def _version():
    return re.search(r'REMODEL_VERSION "(.+)"', (ROOT / "include/remodel/version.h").read_text())[1]


def _metadata():
    return (
        f"Metadata-Version: 2.1\nName: remodel\nVersion: {_version()}\n"
        "Summary: Quality triangular meshes that live while the shape inside them changes\n"
        "License: MIT\nRequires-Python: >=3.9\nRequires-Dist: numpy>=1.20\n"
        "Provides-Extra: plot\nRequires-Dist: matplotlib; extra == 'plot'\n"
        "Provides-Extra: sparse\nRequires-Dist: scipy; extra == 'sparse'\n"
        "Provides-Extra: bridges\nRequires-Dist: meshio; extra == 'bridges'\nRequires-Dist: pyvista; extra == 'bridges'\n"
    )


def _tag():
    version = "cp{}{}".format(*sys.version_info[:2])
    platform = re.sub(r"[-.]", "_", sysconfig.get_platform())
    return f"{version}-{version}-{platform}"


def _built_module():
    """Builds the extension module; its path."""
    directory = Path(os.environ.get("REMODEL_BUILD_DIRECTORY") or ROOT / "build" / "wheel")
    if not (directory / "CMakeCache.txt").exists():
        parts = [f"-DREMODEL_{part}=OFF" for part in ("TESTS", "APP", "STUDY")]
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        subprocess.run(
            ["cmake", "-S", ROOT, "-B", directory, *generator, "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON",
             "-DCMAKE_CXX_FLAGS=-w", *parts, "-DREMODEL_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}"],
            check=True)  # fmt: skip
    subprocess.run(["cmake", "--build", directory, "--target", "remodel_python", "--parallel"], check=True)
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    module = directory / "python" / "remodel" / f"_core{suffix}"
    if not module.exists():
        raise SystemExit(f"{directory}: found no _core{suffix}, expected a build directory for {sys.executable}")
    return module


def _record_line(name, data):
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(data)}\n"


def get_requires_for_build_wheel(config_settings=None):
    return []


def get_requires_for_build_sdist(config_settings=None):
    return []


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    info = f"remodel-{_version()}.dist-info"
    module = _built_module()
    files = {f"remodel/{file.name}": file.read_bytes() for file in sorted(PACKAGE.iterdir()) if file.suffix in (".py", ".pyi") or file.name == "py.typed"}
    files[f"remodel/{module.name}"] = module.read_bytes()
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: remodel\nRoot-Is-Purelib: false\nTag: {_tag()}\n".encode()
    record = "".join(_record_line(name, data) for name, data in files.items()) + f"{info}/RECORD,,\n"
    files[f"{info}/RECORD"] = record.encode()
    name = f"remodel-{_version()}-{_tag()}.whl"
    with zipfile.ZipFile(Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in files.items():
            wheel.writestr(path, data)
    return name


def build_sdist(sdist_directory, config_settings=None):
    base = f"remodel-{_version()}"
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], check=True, stdout=subprocess.PIPE).stdout
    with tarfile.open(Path(sdist_directory) / f"{base}.tar.gz", "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for path in filter(None, listed.decode().split("\0")):
            archive.add(ROOT / path, f"{base}/{path}", recursive=False)
        metadata = Path(sdist_directory) / "PKG-INFO"
        metadata.write_text(_metadata())
        archive.add(metadata, f"{base}/PKG-INFO")
        metadata.unlink()
    return f"{base}.tar.gz"
