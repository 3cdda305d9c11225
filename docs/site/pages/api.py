"""The library's public headers, read by Doxygen and shown by Breathe."""
import shutil
import subprocess
from xml.etree import ElementTree

from . import text

TITLE = "the library's headers"
# What a project that uses the library includes, in the order in which it meets it.
GROUPS = {
    "glsum::kernels": ("kernel.hpp", "weights.hpp", "error_bound.hpp", "catalogue.hpp", "family.hpp"),
    "glsum::design": ("design/mode.hpp", "design/modes.hpp", "design/integral.hpp", "design/blocks.hpp", "design/merged.hpp",
                      "design/bdf.hpp", "design/derivative.hpp", "design/band.hpp", "design/filter.hpp"),
    "glsum::model": ("model/stepper.hpp", "model/controller.hpp"),
}


def _read(source, work):
    settings = f"""
INPUT = {source / 'kernels'}
RECURSIVE = YES
FILE_PATTERNS = *.hpp *.h
STRIP_FROM_PATH = {source / 'kernels'}
STRIP_FROM_INC_PATH = {source / 'kernels'}
OUTPUT_DIRECTORY = {work}
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
XML_PROGRAMLISTING = NO
QUIET = YES
WARNINGS = NO
WARN_IF_UNDOCUMENTED = NO
WARN_IF_DOC_ERROR = NO
WARN_IF_INCOMPLETE_DOC = NO
JAVADOC_AUTOBRIEF = YES
"""
    subprocess.run(["doxygen", "-"], input=settings, text=True, check=True)


def _described(node):
    return any("".join(part.itertext()).strip() for part in (node.find("briefdescription"), node.find("detaileddescription"))
               if part is not None)


def _declared(xml):
    """By header: the directives that show what it declares, and describes, in the order in which it does."""
    found = {}

    def add(node, directive):
        place = node.find("location")
        if place is not None and _described(node):
            found.setdefault(place.get("file"), []).append((int(place.get("line")), directive))

    for path in sorted(xml.glob("*.xml")):
        if not path.name.startswith(("class", "struct", "namespace")):
            continue
        of = ElementTree.parse(path).getroot().find("compounddef")
        name = of.findtext("compoundname")
        if of.get("kind") in ("class", "struct") and "<" not in name:
            add(of, f".. doxygen{of.get('kind')}:: {name}\n   :members:")
        if of.get("kind") == "namespace":
            for member in of.iter("memberdef"):
                kind, full = member.get("kind"), f"{name}::{member.findtext('name')}"
                if kind == "function":
                    arguments = ", ".join("".join(one.find("type").itertext()) for one in member.findall("param"))
                    add(member, f".. doxygenfunction:: {full}({arguments})")
                elif kind == "enum":
                    add(member, f".. doxygenenum:: {full}")
    return {header: [directive for _, directive in sorted(set(all_of_it))] for header, all_of_it in found.items()}


def _page(library, headers, declared, source):
    """In reStructuredText, since the domain of C++ parses its cross references in no other."""
    parts = [f"{library}\n{'=' * len(library)}\n"]
    for header in headers:
        path = f"glsum/{header}"
        parts.append(f"<{path}>\n{'-' * (len(path) + 2)}\n")
        parts.append("::\n\n" + "\n".join("    " + line for line in text.head_comment(source / "kernels" / path).splitlines()) + "\n")
        parts += [directive + "\n" for directive in declared[path]]
    return "\n".join(parts)


def write(source, facts, tree):
    work = facts.parent / "doxygen"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir()
    _read(source, work)
    declared = _declared(work / "xml")
    with open(tree / "conf.py", "a") as conf:
        conf.write(f'breathe_projects = {{"glsum": "{work / "xml"}"}}\n')
    folder = tree / "api"
    folder.mkdir()
    for library, headers in GROUPS.items():
        (folder / f"{_page_of(library)}.rst").write_text(_page(library, headers, declared, source))
    rows = [(f"[{library}]({_page_of(library)}.rst)", ", ".join(f"`{header}`" for header in headers)) for library, headers in GROUPS.items()]
    (folder / "index.md").write_text(
        "# The library's headers\n\n[Use the kernels in your project](../docs/firmware.md) says how they are installed and found. "
        "Names of kernels, as `glsum::ring_plain_f32`, come with `<glsum/registry.hpp>`.\n\n" +
        text.table(("library", "headers"), rows) + "\n" + text.toctree([_page_of(library) for library in GROUPS]))


def _page_of(library):
    return library.replace("::", "-")
