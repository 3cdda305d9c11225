"""build.py SOURCE FACTS OUT PROGRAM: puts the sources of the pages together and has Sphinx make pages of them.

SOURCE is the project, FACTS what `glsum docs` wrote of kernels, cores and effects, OUT the folder of the pages, PROGRAM itself.
Exit status: 0 made, 1 a page could not be made, 3 a program is missing.
"""
import importlib.util
import pathlib
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True  # the project's own folders stay as they are

from pages import api, assemble, cores, effects, families  # noqa: E402

PROGRAMS = {"doxygen": "doxygen", "gnuplot": "gnuplot-nox"}
MODULES = {"sphinx": "python3-sphinx", "furo": "furo", "myst_parser": "python3-myst-parser", "breathe": "python3-breathe"}


def missing():
    """Debian packages of what is not there."""
    return ([package for program, package in PROGRAMS.items() if not shutil.which(program)] +
            [package for module, package in MODULES.items() if not importlib.util.find_spec(module)])


def measure(source, facts, program):
    """The run that the families' costs are of: made once, and again where the program that writes the facts is newer."""
    run = facts / "run.json"
    if run.exists() and run.stat().st_mtime > program.stat().st_mtime:
        return 0
    line = [str(source / "glsum"), "bench", "--quick", "--orders", str(families.ORDER), "--targets", "m7", "--out", str(run)]
    print(" ".join(line), flush=True)
    return subprocess.run(line, stdout=subprocess.DEVNULL, check=False).returncode


def make(source, facts, out, program):
    status = measure(source, facts, program)
    if status:
        return status
    work = facts.parent
    tree = work / "source"
    made = work / "made"
    doctrees = work / "doctrees"  # what an earlier run has read names parts of headers that may be gone
    for folder in (tree, made, doctrees):
        shutil.rmtree(folder, ignore_errors=True)
    print("the READMEs and docs/", flush=True)
    assemble.copy(source, tree)
    for kind in (families, effects, cores, api):
        print(kind.TITLE, flush=True)
        kind.write(source, facts, tree)
    print("the pages", flush=True)
    sphinx = subprocess.run(
        [sys.executable, "-m", "sphinx", "-b", "html", "-q", "-W", "--keep-going", "-d", str(doctrees), str(tree), str(made)],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if sphinx.returncode:
        print(f"{sphinx.stdout}glsum: docs: Sphinx expected pages without fault, and found the above", file=sys.stderr)
        return 1
    shutil.rmtree(out, ignore_errors=True)
    out.parent.mkdir(parents=True, exist_ok=True)
    shutil.move(made, out)
    print(f"{len(list(out.rglob('*.html')))} pages; open {out / 'index.html'}")
    return 0


if __name__ == "__main__":
    if missing():
        print(f"glsum: docs: not found: {' '.join(missing())} (Debian packages)", file=sys.stderr)
        sys.exit(3)
    sys.exit(make(*(pathlib.Path(word) for word in sys.argv[1:5])))
