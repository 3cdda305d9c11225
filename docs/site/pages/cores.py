"""A page for each core file: its figures, each with how it is known and by whom."""
import json

from . import text

TITLE = "core files"


def _meanings(source):
    """What each figure means, by the comments of the rows' lists."""
    found = {}
    for path in ("m7_rows.def", "rows.def", "cortex_m4/rows.def"):
        for line in (source / "qemu/timing" / path).read_text().splitlines():
            if line.startswith("ROW("):
                row, _, meaning = line.partition("//")
                section, name = row[4:row.index(")")].split(",")
                found[f"{section.strip()}.{name.strip()}"] = meaning.strip()
    return found


def _page(core, meanings):
    marks = {mark: sum(one["mark"] == mark for one in core["figures"]) for mark in ("measured", "documented", "fitted", "assumed")}
    parts = [
        f"# {core['name']}\n",
        f"{core['note'][0].upper()}{core['note'][1:]}.\n",
        f"The model is the {core['core'].replace('_', '-')}'s. Code lies in {core['code']}, data in {core['data']}.\n",
        "Of its figures " + ", ".join(f"{count} are {mark}" for mark, count in marks.items() if count) + ".\n",
        text.code(f"./glsum time --elf app.elf --function step --core {core['name']}\n"
                  f"./glsum bench --quick --targets {core['core'].removeprefix('cortex-')}:{core['name']}"),
    ]
    if core["rivals"]:
        parts.append("## Rival rules\n\nA figure is printed with the range over the rules that fit silicon as well.\n")
        parts.append(text.table(("rules", "what they say", "fit silicon", "differ in"),
                                [(one["name"], one["note"], "yes" if one["fits"] else "no",
                                  ", ".join(f"`{row['key']}` {row['value']}" for row in one["differs"])) for one in core["rivals"]]))
    parts.append("## Figures\n")
    sections = dict.fromkeys(one["key"].split(".")[0] for one in core["figures"])
    for section in sections:
        rows = [(f"`{one['key'].split('.')[1]}`", one["value"], meanings.get(one["key"], ""), one["mark"], one["source"])
                for one in core["figures"] if one["key"].split(".")[0] == section]
        parts.append(f"### {section}\n\n" + text.table(("figure", "value", "meaning", "known", "source"), rows))
    return "\n".join(parts)


def write(source, facts, tree):
    cores = json.loads((facts / "cores.json").read_text())
    meanings = _meanings(source)
    folder = tree / "cores"
    folder.mkdir()
    for core in cores:
        (folder / f"{core['name']}.md").write_text(_page(core, meanings))
    rows = [(f"[`{core['name']}`]({core['name']}.md)", core["note"]) for core in cores]
    (folder / "index.md").write_text(
        "# Core files\n\nA core file holds every figure of a modelled core, with its source and how far it may be trusted. "
        "[A file for your own chip](../docs/core-files.md) says how to write one. "
        "[The timing model](../docs/timing-model.md) says how far figures were from silicon.\n\n" +
        text.table(("core file", "what it models"), rows) + "\n" + text.toctree([core["name"] for core in cores]))
