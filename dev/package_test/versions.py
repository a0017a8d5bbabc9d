"""Other versions of the packages, as an archive would bring them: repacked, not built again."""

from hosts import run


def reversioned(packages, version, folder, station=None):
    """`station`: a program in the place of ols-station."""
    made = []
    for package in packages:
        tree = folder / f"tree-{version}-{package.name}"
        run("dpkg-deb", "--raw-extract", package, tree)
        control = tree / "DEBIAN/control"
        before = run("dpkg-deb", "--field", package, "Version").stdout.strip()
        text = control.read_text().replace(f"Version: {before}\n", f"Version: {version}\n")
        control.write_text(text.replace(f"(= {before})", f"(= {version})"))
        program = tree / "usr/bin/ols-station"
        if station is not None and program.exists():
            program.write_text(station)
        made.append(folder / f"{package.name.split('_')[0]}_{version}_amd64.deb")
        run("dpkg-deb", "--root-owner-group", "-Zgzip", "-z1", "--build", tree, made[-1])
        run("rm", "-rf", tree)
    return made
