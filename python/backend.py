"""What pip calls to make a wheel (PEP 517): builds oriel by CMake and packs what the component `python` installs.

Debian 12 has no scikit-build-core. `--config-settings build-dir=build/release` takes a build tree that is there already.
"""
import base64
import hashlib
import os
import pathlib
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
SOURCES = HERE.parent
# What is in a zip has this time: the same build gives the same wheel.
TIME = (1980, 1, 1, 0, 0, 0)


def _build(tree):
    """Configures a tree that is not there; builds the module."""
    if not (tree / "CMakeCache.txt").exists():
        subprocess.run(["cmake", "--preset", "release", "-B", str(tree), "-DORIEL_TESTS=OFF", "-DORIEL_EXAMPLES=OFF",
                        "-DORIEL_COMMAND=OFF", "-DORIEL_UNITY=ON", "-DORIEL_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}"],
                       cwd=SOURCES, check=True)
    subprocess.run(["cmake", "--build", str(tree), "--target", "oriel_python"], check=True)


def _install(tree, folder):
    """The files of the module, in `folder`; returns the folder that has the package."""
    subprocess.run(["cmake", "--install", str(tree), "--component", "python", "--prefix", folder, "--strip"], check=True,
                   stdout=subprocess.DEVNULL)
    return next(pathlib.Path(folder).rglob("oriel/__init__.py")).parents[1]


def _record_line(name, data):
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(data)}\n"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    tree = pathlib.Path((config_settings or {}).get("build-dir", SOURCES / "build" / "python")).resolve()
    _build(tree)
    with tempfile.TemporaryDirectory() as folder:
        packages = _install(tree, folder)
        info = next(packages.glob("oriel-*.dist-info")).name
        tag = f"cp{sys.version_info[0]}{sys.version_info[1]}"
        platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
        wheel_tag = f"{tag}-{tag}-{platform}"
        files = {str(path.relative_to(packages)): path.read_bytes() for path in sorted(packages.rglob("*")) if path.is_file()}
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: oriel\nRoot-Is-Purelib: false\nTag: {wheel_tag}\n".encode()
    record = f"{info}/RECORD"
    files[record] = ("".join(_record_line(name, data) for name, data in files.items()) + f"{record},,\n").encode()
    wheel = f"{info.removesuffix('.dist-info')}-{wheel_tag}.whl"
    with zipfile.ZipFile(os.path.join(wheel_directory, wheel), "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, TIME)
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, data, zipfile.ZIP_DEFLATED, compresslevel=1)
    return wheel
