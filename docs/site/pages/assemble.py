"""The project's own pages, copied so that their links hold among the pages of the site."""
import os
import pathlib
import re
import shutil

from . import text

LEFT_OUT = {"build", ".git", ".ci", ".github", "node_modules"}
LINK = re.compile(r"\[([^\]]*)\]\(([^)#:\s]+)(#[^)\s]*)?\)")


def _found(source):
    for folder, folders, files in os.walk(source):
        folders[:] = sorted(one for one in folders if one not in LEFT_OUT)
        for name in sorted(files):
            if name.endswith(".md"):
                yield (pathlib.Path(folder) / name).relative_to(source)


def _mended(words, page, source):
    """A folder's link leads to its README; where it has none, it is no link."""
    def mend(link):
        words, target, anchor = link.group(1), link.group(2), link.group(3) or ""
        path = source / page.parent / target
        if not path.is_dir():
            return link.group(0)
        return f"[{words}]({target.rstrip('/')}/README.md{anchor})" if (path / "README.md").exists() else words
    return LINK.sub(mend, words)


def _copied_files(words, page, source, tree):
    for link in LINK.finditer(words):
        path = source / page.parent / link.group(2)
        if path.is_file() and path.suffix != ".md":
            to = tree / path.resolve().relative_to(source.resolve())
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, to)


def _below(page, all_pages):
    """What a page that maps others lists beside the text: the rooms' READMEs, and all of docs/."""
    name = str(page)
    if name == "README.md":
        listed = [one for one in all_pages if one != page and one.parts[0] != "docs"]
    elif name == "docs/README.md":
        listed = [one for one in all_pages
                  if one.parts[0] == "docs" and one != page and one.parts[1] != "tutorials"]
    else:
        return ""
    names = [os.path.relpath(one.with_suffix(""), page.parent) for one in listed]
    return "\n" + text.toctree(names)


def copy(source, tree):
    """Every page below `source`, to the same place below `tree`; what they show or offer, too."""
    all_pages = list(_found(source))
    for page in all_pages:
        words = (source / page).read_text()
        to = tree / page
        to.parent.mkdir(parents=True, exist_ok=True)
        to.write_text(_mended(words, page, source) + _below(page, all_pages))
        _copied_files(words, page, source, tree)
    static = tree / "_static"
    static.mkdir()
    shutil.copy(source / "docs/site/glsum.css", static)
    shutil.copy(source / "docs/site/conf.py", tree)
    shutil.copy(source / "docs/site/index.myst", tree / "index.md")  # no .md here: its links are the site's
