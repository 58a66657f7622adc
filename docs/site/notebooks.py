"""Notebooks as pages: their JSON becomes Markdown before it is parsed; stored outputs are shown, nothing is run."""
import json


def fence(text, language=""):
    return f"````{language}\n{text.rstrip()}\n````\n"


def text_of(value):
    return value if isinstance(value, str) else "".join(value)


def output_markdown(output):
    data = output.get("data", {})
    if "image/svg+xml" in data:
        return fence(text_of(data["image/svg+xml"]), "{raw} html")
    if "image/png" in data:
        return f"![](data:image/png;base64,{text_of(data['image/png']).replace(chr(10), '')})\n"
    text = text_of(output.get("text", data.get("text/plain", "")))
    return fence(text, "text") if text.strip() else ""


def cell_markdown(cell):
    text = text_of(cell["source"])
    if cell["cell_type"] == "markdown":
        return text + "\n"
    if cell["cell_type"] == "raw" or not text.strip():
        return ""
    return "\n".join([fence(text, "python"), *map(output_markdown, cell.get("outputs", []))])


def markdown(notebook):
    return "\n".join(map(cell_markdown, json.loads(notebook)["cells"]))


def read_notebook(app, page, source):
    if app.env.doc2path(page).endswith(".ipynb"):
        source[0] = markdown(source[0])


def setup(app):
    app.add_source_suffix(".ipynb", "markdown")
    app.connect("source-read", read_notebook, priority=400)  # before pages are added to it
    return {"parallel_read_safe": True}
