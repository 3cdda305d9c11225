# Sphinx's settings, for the sources that build.py puts together.
project = "glsum"
author = "the authors of glsum"
html_title = "glsum"
extensions = ["myst_parser", "breathe"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
root_doc = "index"
html_theme = "furo"
html_static_path = ["_static"]
html_css_files = ["glsum.css"]
html_copy_source = False
html_show_sphinx = False
html_show_copyright = False
highlight_language = "none"
# Of the highlighter's styles the two whose faintest word still has a contrast of 4.5 to 1 with its ground, as WCAG 2 asks.
pygments_style = "xcode"
pygments_dark_style = "github-dark"
myst_heading_anchors = 4
myst_enable_extensions = ["colon_fence"]
breathe_default_project = "glsum"
cpp_id_attributes = ["__attribute__"]
# A page may stand alone: rooms are reached from the map, measured tables from the pages that quote them.
suppress_warnings = ["toc.excluded", "myst.header"]
