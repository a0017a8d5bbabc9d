"""Writes a software bill of materials (CycloneDX) beside packages: sbom.py FOLDER

It has the packages; those that they depend on, down to the C library, in the versions of this
machine, or of Debian's archive for what is not installed here; the libraries whose headers they
were compiled with; and those of the console's page.
"""

import base64
import json
import re
import subprocess
import sys
import uuid
from pathlib import Path

from debian.deb822 import Deb822, Packages

LOCK = Path("console/page/package-lock.json")
PAGE = "ols-console"  # the package that has the page
INSTALLED = "Status: install ok installed\n"


def said(*command, **options):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, **options).stdout


def named_in(paragraph, *fields):
    """The first of alternatives, as Debian's build machines take it."""
    relations = Packages(paragraph).relations
    return {alternatives[0]["name"] for name in fields for alternatives in relations[name.lower()]}


def directly_needed_by(packages):
    ours = {package["Package"] for package in packages}
    return set().union(*(named_in(package, "Depends") for package in packages)) - ours


def needed_by(direct):
    unwanted = ("recommends", "suggests", "conflicts", "breaks", "replaces", "enhances")
    options = [f"--no-{relation}" for relation in unwanted]
    tree = said("apt-cache", "depends", "--recurse", "--installed", *options, *sorted(direct))
    control = Deb822(Path("debian/control").read_text())
    wanted = re.findall(r"[\w.+-]+-dev", control["Build-Depends"])
    return sorted(set(re.findall(r"^[a-z0-9][\w.+-]+", tree, flags=re.M)).union(wanted))


def state_of_others(packages):
    direct = directly_needed_by(packages)
    # What is not here is another choice where one is enough, or is needed and not for a build.
    query = ("dpkg-query", "--status", *needed_by(direct))
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
    here = subprocess.run(query, check=False, text=True, **options).stdout
    missing = direct - set(re.findall(r"^Package: (\S+)$", here, flags=re.M))
    shown = [said("apt-cache", "show", "--no-all-versions", name) for name in sorted(missing)]
    paragraphs = [part.strip() for part in re.split(r"\n\n+", here)]
    # Nothing is shown of a name that others provide.
    return [*paragraphs, *(f"{part.strip()}\n{INSTALLED}" for part in shown if part)]


def page_libraries():
    packages = json.loads(LOCK.read_text())["packages"]
    for path, package in packages.items():
        if path == "" or package.get("dev"):
            continue
        name = path.rpartition("node_modules/")[2]
        reference = f"pkg:npm/{name.replace('@', '%40')}@{package['version']}"
        algorithm, _, digest = package["integrity"].partition("-")
        content = base64.b64decode(digest).hex()
        yield {
            "bom-ref": reference,
            "hashes": [{"alg": algorithm.upper().replace("SHA", "SHA-"), "content": content}],
            "licenses": [{"expression": package["license"]}],
            "name": name,
            "purl": reference,
            "type": "library",
            "version": package["version"],
        }


def add_page(bill):
    libraries = list(page_libraries())
    bill["components"] += libraries
    page = next(part["bom-ref"] for part in bill["components"] if part["name"] == PAGE)
    needs = next(entry for entry in bill["dependencies"] if entry["ref"] == page)
    references = (library["bom-ref"] for library in libraries)
    needs["dependsOn"] = sorted([*needs.get("dependsOn", []), *references])


def main(folder):
    paths = [path for path in sorted(folder.glob("*.deb")) if "-dbgsym_" not in path.name]
    packages = [Deb822(said("dpkg-deb", "--field", path)) for path in paths]
    own = [f"{package}{INSTALLED}".strip() for package in packages]
    state = "\n\n".join([*own, *state_of_others(packages)])
    date = said("dpkg-parsechangelog", "--show-field", "Timestamp").strip()
    when = said("date", "--utc", f"--date=@{date}", "+%FT%TZ").strip()
    version = packages[0]["Version"]
    built_for = max(
        package["Architecture"] for package in packages if package["Architecture"] != "all"
    )
    output = folder / f"ols_{version}.cdx.json"
    generate = ("debsbom", "generate", "--from-pkglist", "--sbom-type", "cdx", "--timestamp", when)
    serial = str(uuid.uuid5(uuid.NAMESPACE_URL, state))
    described = ("--distro-name", "ols", "--distro-version", version, "--distro-arch", built_for)
    numbered = ("--cdx-serialnumber", serial, "--out", "-")
    command = [Path(sys.executable).with_name(generate[0]), *generate[1:], *described, *numbered]
    bill = json.loads(said(*command, input=state))
    add_page(bill)
    output.write_text(json.dumps(bill, indent=1, sort_keys=True) + "\n")
    print(f"{output}: {len(bill['components'])} components")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
