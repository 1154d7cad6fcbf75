#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""debian_root.py PACKAGES SOURCES EXAMPLES CACHE WORK: a clean Debian 12, made by debootstrap, in which the packages are
installed by apt from Debian's mirror, used and removed again: the program, a program in C by gcc and pkg-config, the Python
module. Ends with 77 and the reason where that cannot be done: not root, no debootstrap, no mount namespaces, no mirror.

CACHE keeps the root as debootstrap leaves it (a week) and what apt has loaded. Mounts live in a namespace of their own, which
ends with this process."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time
import urllib.request

from steps import environment, require, run, skip

SUITE = "bookworm"
WEEK = 7 * 24 * 3600


def mirror():
    """The first source of apt's that has SUITE."""
    for path in sorted(pathlib.Path("/etc/apt").glob("sources.list*")):
        files = sorted(path.iterdir()) if path.is_dir() else [path]
        for text in (file.read_text(errors="replace") for file in files if file.suffix in (".list", ".sources")):
            for options, uri, suite in re.findall(r"^\s*deb\s+(\[[^\]]*\]\s*)?(\S+)\s+(\S+)", text, re.M):
                if suite == SUITE:
                    return uri.rstrip("/")
            for stanza in text.split("\n\n"):
                fields = dict(re.findall(r"^(\w[\w-]*):\s*(.*)$", stanza, re.M))
                if "deb" in fields.get("Types", "").split() and SUITE in fields.get("Suites", "").split():
                    return fields["URIs"].split()[0].rstrip("/")
    return None


def reasons_to_skip(uri):
    if os.geteuid() != 0:
        return "needs root, for debootstrap and chroot"
    for program in ("debootstrap", "unshare", "chroot"):
        if shutil.which(program, path=os.environ["PATH"] + ":/usr/sbin:/sbin") is None:
            return f"{program} is not installed"
    if subprocess.run(["unshare", "--mount", "--propagation", "private", "true"], check=False,
                      capture_output=True).returncode != 0:
        return "no mount namespace can be made here"
    if uri is None:
        return f"apt's sources name no mirror that has {SUITE}"
    try:
        urllib.request.urlopen(f"{uri}/dists/{SUITE}/Release", timeout=20).read(1)
    except OSError as error:
        return f"the mirror {uri} does not answer: {error}"
    return None


class Root:
    def __init__(self, uri, cache, folder):
        self.cache, self.folder = cache, folder
        self.debs = folder / "tmp" / "debs"
        kept = cache / f"{SUITE}.tar"
        self.remove()
        folder.mkdir(parents=True)
        if kept.is_file() and time.time() - kept.stat().st_mtime < WEEK:
            run("tar", "-xpf", kept, "-C", folder)
        else:
            run("debootstrap", "--variant=minbase", SUITE, folder, uri, env=self.environment())
            cache.mkdir(parents=True, exist_ok=True)
            run("tar", "-cpf", f"{kept}.new", "--one-file-system", "--exclude=./var/cache/apt/archives/*.deb", "-C", folder, ".")
            os.replace(f"{kept}.new", kept)
        shutil.copy("/etc/resolv.conf", folder / "etc" / "resolv.conf")
        (folder / "etc" / "dpkg" / "dpkg.cfg.d" / "speed").write_text("force-unsafe-io\n")
        archives = cache / "archives"
        (archives / "partial").mkdir(parents=True, exist_ok=True)
        for kind, source, place in (("--bind", archives, "var/cache/apt/archives"), ("-tproc", "proc", "proc")):
            done = subprocess.run(["mount", kind, str(source), str(folder / place)], check=False, capture_output=True)
            if done.returncode != 0:  # the root works without either
                print(f"not mounted: {place}: {done.stderr.decode().strip()}")
        self.run("apt-get", "update", "-q")

    def environment(self):
        return {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "LC_ALL": "C", "HOME": "/root", "DEBIAN_FRONTEND": "noninteractive",
                **{name: value for name, value in environment().items() if name.lower().endswith("_proxy")}}

    def run(self, *words, expect=0):
        return run("chroot", self.folder, *words, expect=expect, env=self.environment())

    def install(self, *packages):
        self.run("apt-get", "install", "-y", "-q", "--no-install-recommends", *packages)

    def remove(self):
        if self.folder.exists():
            run("rm", "-rf", "--one-file-system", self.folder)


def use_program(root, examples):
    shutil.copy(examples / "cup.json", root.folder / "tmp")
    output = root.run("patchproof", "certify", "/tmp/cup.json")
    require("65 joins:" in output, f"patchproof certify says\n{output}")
    parts = sorted((examples / "cad").glob("*.step"))
    if "libocct-data-exchange" in root.run("dpkg-query", "-W", "-f=${Depends}", "patchproof-tools"):
        require(parts != [], "there is no example of a STEP file")
        shutil.copy(parts[0], root.folder / "tmp" / "part.step")
        root.run("patchproof", "certify", "/tmp/part.step")


def build_program(root, sources):
    shutil.copy(sources / "c" / "main.c", root.folder / "tmp")
    root.run("sh", "-c", "gcc -std=c99 -Wall -Werror /tmp/main.c -o /tmp/outside $(pkg-config --cflags --libs patchproof)")
    output = root.run("/tmp/outside")
    require("C0 0, G1 1, angle in [" in output, f"the C program says\n{output}")
    require(root.run("dpkg-query", "-W", "-f=${Package}\n").find("libcgal") < 0, "C programs need CGAL's headers")


def use_python(root):
    output = root.run("python3", "-c", "import json, patchproof\n"
                      "print(json.dumps([patchproof.__file__, len(patchproof.read('/tmp/cup.json').patches)]))")
    file, patches = json.loads(output)
    require(file.startswith("/usr/lib/python3/dist-packages/") and patches == 35, f"Python says {output}")


def inside(packages, sources, examples, cache, work):
    started = time.time()
    root = Root(mirror(), cache, work)
    try:
        root.debs.mkdir()
        names = {}
        for path in sorted(packages.glob("*.deb")):
            shutil.copy(path, root.debs)
            names[path.name.split("_")[0]] = f"/tmp/debs/{path.name}"
        print(f"{time.time() - started:5.0f} s: a clean root with {len(names)} packages to install")
        runtime = next(name for name in names if re.fullmatch(r"libpatchproof\d+", name))
        root.install(names[runtime], names["patchproof-tools"])
        use_program(root, examples)
        print(f"{time.time() - started:5.0f} s: the program works")
        root.install(names["libpatchproof-dev"], "gcc", "libc6-dev", "pkgconf")
        build_program(root, sources)
        print(f"{time.time() - started:5.0f} s: a program in C is built and works")
        if "python3-patchproof" in names:
            root.install(names["python3-patchproof"])
            use_python(root)
            print(f"{time.time() - started:5.0f} s: the Python module works")
        changed = root.run("dpkg", "--verify", *names)
        require(changed.strip() == "", f"dpkg --verify:\n{changed}")

        root.run("apt-get", "purge", "-y", "-q", *names)
        left = [line for line in root.run("find", "/usr", "/etc", "/var/lib", "-xdev", "-name", "*patchproof*").splitlines()
                if not line.startswith("/var/lib/apt/")]
        require(left == [], f"not removed: {left}")
        print(f"{time.time() - started:5.0f} s: removed without a trace")
    finally:
        subprocess.run(["umount", str(root.folder / "proc")], check=False, capture_output=True)
        subprocess.run(["umount", str(root.folder / "var/cache/apt/archives")], check=False, capture_output=True)
        root.remove()


def main():
    if sys.argv[1] == "--inside":
        return inside(*map(pathlib.Path, sys.argv[2:]))
    uri = mirror()
    reason = reasons_to_skip(uri)
    if reason is not None:
        skip(reason)
    os.execvp("unshare", ["unshare", "--mount", "--propagation", "private", sys.executable, "-B", __file__, "--inside",
                          *sys.argv[1:]])


main()
