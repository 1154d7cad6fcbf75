#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Debian packages, made from the build folder and read back.
    packages.py make CPACK BUILD WORK                    into WORK/packages
    packages.py check WORK PACKAGES_TXT VERSION ABI LIBDIR
"""
import gzip
import pathlib
import re
import shutil
import stat
import subprocess
import sys
import tarfile

from steps import dynamic_section, environment, fail, require, run

MAINTAINER = re.compile(r"[^<>]+ <[^<>@ ]+@[^<>@ ]+\.[a-z]+>")


def make(cpack, build, work):
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    run(cpack, "--config", f"{build}/CPackConfig.cmake", "-B", work, "-D", f"CPACK_OUTPUT_FILE_PREFIX={work}/packages",
        "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip", cwd=work, env=environment())  # xz takes half a minute longer
    shutil.rmtree(work / "_CPack_Packages")
    for path in sorted((work / "packages").glob("*.deb")):
        print(f"{path.name}  {path.stat().st_size / 1e6:.2f} MB")


class Package:
    def __init__(self, path, work):
        self.path = path
        self.folder = work / "unpacked" / path.stem
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.parent.mkdir(exist_ok=True)
        run("dpkg-deb", "-R", path, self.folder)
        self.control = dict(re.findall(r"^(\S+): (.*)$", (self.folder / "DEBIAN" / "control").read_text(), re.M))
        self.text = (self.folder / "DEBIAN" / "control").read_text()
        self.name = self.control["Package"]
        plain = work / "unpacked" / f"{path.stem}.tar"
        with open(plain, "wb") as out:
            out.write(subprocess.run(["dpkg-deb", "--fsys-tarfile", path], check=True,
                                                   capture_output=True).stdout)
        with tarfile.open(plain) as tar:
            self.members = tar.getmembers()
        self.texts = [f"usr/share/doc/{self.name}/{text}" for text in ("changelog.Debian.gz", "copyright")]
        self.files = sorted(m.name.removeprefix("./") for m in self.members if not m.isdir())

    def complain(self, sentence):
        fail(f"{self.path.name}: {sentence}")

    def require(self, condition, sentence):
        if not condition:
            self.complain(sentence)

    def depends(self):
        return self.control.get("Depends", "")

    def check_form(self, version):
        """What any good package has: names, owners, modes, checksums, a licence, stripped binaries."""
        architecture = run("dpkg", "--print-architecture").strip()
        self.require(self.control["Version"] == f"{version}-1", f"version {self.control['Version']}")
        self.require(self.control["Architecture"] == architecture, f"architecture {self.control['Architecture']}")
        self.require(self.path.name == f"{self.name}_{version}-1_{architecture}.deb", "the file has another name")
        self.require(MAINTAINER.fullmatch(self.control["Maintainer"]), f"maintainer {self.control['Maintainer']}")
        self.require(self.control["Priority"] == "optional" and "Section" in self.control, "priority, section")
        synopsis = self.control["Description"]
        self.require(10 < len(synopsis) < 80 and synopsis[0].islower() and synopsis[-1] != ".", f"synopsis '{synopsis}'")
        description = self.text.split("Description: ")[1].split("\n")
        lines = [line for line in description[1:] if line.startswith(" ")]
        self.require(len(lines) > 4 and " ." in lines and all(len(line) <= 80 for line in lines), f"description {lines}")
        for member in self.members:
            self.require((member.uid, member.gid) == (0, 0), f"{member.name} belongs to {member.uid}:{member.gid}")
            self.require(member.issym() or member.mode & 0o7777 in (0o644, 0o755), f"{member.name}: {member.mode:o}")
            self.require(member.name.startswith("./usr") or member.name in (".", "./"), f"{member.name} is outside /usr")
            self.require("usr/local" not in member.name, f"{member.name}")
        sums = (self.folder / "DEBIAN" / "md5sums").read_text().splitlines()
        named = sorted(line.split(None, 1)[1].removeprefix("./") for line in sums)
        self.require(named == sorted(m.name.removeprefix("./") for m in self.members if m.isfile()), "md5sums")
        self.require(set(self.texts) <= set(self.files), f"{self.texts} are not all there")
        entry = gzip.decompress((self.folder / self.texts[0]).read_bytes()).decode("utf-8")
        self.require(entry.startswith(f"patchproof ({version}-1) ") and f"-- {self.control['Maintainer']}  " in entry, entry)
        for path in (self.folder / name for name in self.files):
            if path.is_file() and not path.is_symlink() and path.suffix != ".a" and path.read_bytes()[:4] == b"\x7fELF":
                sections = run("readelf", "-SW", path, env=environment())
                self.require(".symtab" not in sections and ".debug_info" not in sections, f"{path.name} is not stripped")
                mode = stat.S_IMODE(path.stat().st_mode)
                self.require(mode == (0o755 if "/bin/" in str(path) else 0o644), f"{path.name} has mode {mode:o}")

    def copyright(self):
        return (self.folder / "usr" / "share" / "doc" / self.name / "copyright").read_text(encoding="utf-8")


def check_runtime(package, abi, version, libdir):
    folder = f"usr/{libdir}"
    own = [f"{folder}/libpatchproof.so.{abi}", f"{folder}/libpatchproof.so.{version}", *package.texts]
    package.require(package.files == sorted(own), f"contains {package.files}")
    for name in ("libc6", "libgmp10", "libmpfr6", "libmpfi0", "libtbb12", "libfmt9", "libpugixml1v5", "libmd0", "libstdc++6"):
        package.require(re.search(rf"(^|, ){re.escape(name)}( \(|,|$)", package.depends()),
                        f"does not depend on {name}: {package.depends()}")
    package.require("occt" not in package.depends(), f"depends on Open CASCADE: {package.depends()}")
    shlibs = (package.folder / "DEBIAN" / "shlibs").read_text()
    package.require(shlibs.startswith(f"libpatchproof {abi} {package.name} (>= {version}"), f"shlibs '{shlibs}'")
    triggers = package.folder / "DEBIAN" / "triggers"
    package.require(triggers.is_file() and "ldconfig" in triggers.read_text(), "ldconfig is not told")
    package.require("LGPL" in package.copyright() and "GPL-3.0-or-later (/usr/share/common-licenses/GPL-3)"
                    not in package.copyright(), "the copyright text is another package's")


def check_dev(package, abi, version, libdir, packages_txt):
    package.require(package.depends() == f"libpatchproof{abi} (= {version}-1)", f"depends on {package.depends()}")
    wanted = [f"usr/{libdir}/{name}" for name in (
        "libpatchproof.so", "libpatchproof.a", "libpatchproof_exact.a", "libpatchproof_kernels.a",
        "cmake/patchproof/patchproof-config.cmake", "cmake/patchproof/patchproof-config-version.cmake",
        "pkgconfig/patchproof.pc", "pkgconfig/patchproof-static.pc", "pkgconfig/patchproof-cxx.pc")]
    for name in wanted + ["usr/include/patchproof/c_api.h", "usr/include/patchproof/join/certify.h"]:
        package.require(name in package.files, f"{name} is missing")
    outside = [name for name in package.files if not re.match(r"usr/(include/patchproof|share/doc|" + libdir + ")/", name)]
    package.require(outside == [], f"{outside} belong to another package")
    recommended = [name.strip() for name in package.control["Recommends"].split(",")]
    known = {line.strip() for line in packages_txt.read_text().splitlines()}
    package.require(set(recommended) <= known, f"{sorted(set(recommended) - known)} are not in packages.txt")


def check_tools(package):
    own = ["usr/bin/patchproof", *package.texts, "usr/share/man/man1/patchproof.1.gz"]
    package.require(package.files == own, f"contains {package.files}")
    libraries = [value for tag, value in dynamic_section(package.folder / own[0]) if tag == "NEEDED"]
    occt = any(name.startswith("libTK") for name in libraries)
    package.require(occt == ("libocct-data-exchange" in package.depends()), f"depends on {package.depends()}")
    package.require("GPL-3.0-or-later" in package.copyright() and "CLI11" in package.copyright(), "the copyright text")

    manual = gzip.decompress((package.folder / own[-1]).read_bytes()).decode("utf-8")
    says = run(package.folder / own[0], "--help").split("Subcommands:")[1].split("Exit codes")[0]
    for subcommand in re.findall(r"^  (\w+) ", says, re.M):
        package.require(f"\n.B {subcommand}\n" in manual, f"the manual page says nothing of {subcommand}")


def check_python(package, abi, version):
    modules = [name for name in package.files if name.endswith(".so")]
    package.require(len(modules) == 1 and modules[0].startswith("usr/lib/python3/dist-packages/patchproof/"), f"{modules}")
    package.require("usr/lib/python3/dist-packages/patchproof/__init__.py" in package.files, "there is no __init__.py")
    tag = re.search(r"cpython-3(\d+)", modules[0])
    for needed in (f"libpatchproof{abi} (= {version}-1)", "python3-numpy", f"python3 (>= 3.{tag.group(1)})",
                   f"python3 (<< 3.{int(tag.group(1)) + 1})"):
        package.require(needed in package.depends(), f"does not depend on {needed}: {package.depends()}")
    package.require("pybind11" in package.copyright(), "the copyright text")
    for script, command in (("postinst", "py3compile"), ("prerm", "py3clean")):
        package.require(command in (package.folder / "DEBIAN" / script).read_text(), f"{script} does not call {command}")


def check(work, packages_txt, version, abi, libdir):
    packages = {}
    for path in sorted((work / "packages").glob("*.deb")):
        package = Package(path, work)
        packages[package.name] = package
    runtime = f"libpatchproof{abi}"
    expected = {runtime, "libpatchproof-dev", "patchproof-tools"}
    require(expected <= set(packages) <= expected | {"python3-patchproof"}, f"packages {sorted(packages)}")

    owners = {}
    for package in packages.values():
        package.check_form(version)
        for name in package.files:
            require(name not in owners, f"{name} is in {package.name} and in {owners.get(name)}")
            owners[name] = package.name
    check_runtime(packages[runtime], abi, version, libdir)
    check_dev(packages["libpatchproof-dev"], abi, version, libdir, packages_txt)
    check_tools(packages["patchproof-tools"])
    if "python3-patchproof" in packages:
        check_python(packages["python3-patchproof"], abi, version)
    shutil.rmtree(work / "unpacked")
    print(f"{len(packages)} packages, {len(owners)} files")


def main():
    if sys.argv[1] == "make":
        make(sys.argv[2], sys.argv[3], pathlib.Path(sys.argv[4]))
    else:
        check(pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3]), *sys.argv[4:])


main()
