"""Pieces of Markdown."""


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(str(cell).replace("|", "\\|") for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def code(text, language=""):
    return f"```{language}\n{text.rstrip()}\n```\n"


def number(value):
    """Four significant digits, lists by element, words as they are."""
    if isinstance(value, list):
        return "[" + ", ".join(number(one) for one in value) + "]"
    return value if isinstance(value, str) else f"{value:.4g}"


def head_comment(path):
    """The comment that a source begins with, without its marks."""
    lines = []
    for line in path.read_text().splitlines():
        if not line.startswith("//"):
            break
        lines.append(line[2:].removeprefix(" "))
    return "\n".join(lines)


def toctree(pages):
    return "```{toctree}\n:hidden:\n" + "\n".join(pages) + "\n```\n"
