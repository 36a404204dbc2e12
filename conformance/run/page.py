#!/usr/bin/python3
"""Makes one self-contained HTML page of a JSON file: page.py DATA.json PAGE.html

The JSON: {"title": …, "notes": [text…], "sections": [{"heading": …, "text": …, "blocks": [block…]}…]}. A block is one of
  {"type": "table", "columns": [heading…], "rows": [[cell…]…]}         columns of numbers are set to the right
  {"type": "images", "images": [{"file": …, "caption": …}…]}            PNGs beside the JSON; they are put into the page
  {"type": "scatter", "title", "x_label", "x_log", "y_label", "y_log", "points": [{"series", "label", "x", "y"}…],
   "lines"}                                                             true: the points of a series are connected
  {"type": "bars", "title", "y_label", "y_log", "groups": [name…], "series": {name: [value or null…]…}, "order": [name…],
   "wide"}                                                              true: as wide as the page
"""

import base64
import html
import io
import json
import pathlib
import sys

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "lapilli", "font.family": "sans-serif",
                            "font.size": 10, "axes.grid": True, "grid.alpha": 0.3, "axes.spines.top": False,
                            "axes.spines.right": False, "legend.frameon": False})
import matplotlib.pyplot as plt  # noqa: E402  after the backend is chosen

STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; max-width: 76rem; margin: 2rem auto; padding: 0 1rem; color: #1c1e21; }
h1 { font-size: 1.7rem; margin-bottom: .3rem } h2 { margin-top: 2.2rem; border-bottom: 1px solid #ccc; font-size: 1.2rem }
.notes { color: #555; font-size: 13px } .scroll { overflow-x: auto }
table { border-collapse: collapse; font-size: 13px; font-variant-numeric: tabular-nums }
th, td { padding: .25rem .7rem; text-align: left; white-space: nowrap } th { border-bottom: 2px solid #888 }
th { white-space: normal; vertical-align: bottom } td.n, th.n { text-align: right } tr.group td { border-top: 1px solid #ccc }
figure { display: inline-block; margin: .5rem .6rem .5rem 0; vertical-align: top } figcaption { font-size: 13px; color: #555 }
figure img { width: 23rem; max-width: 100%; display: block; background: #000 } svg { max-width: 100%; height: auto }
"""
COLORS = ["#d9480f", "#1971c2", "#2f9e44", "#862e9c", "#5c940d", "#495057"]
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "*"]


def is_number(text):
    try:
        float(text)
        return True
    except ValueError:
        return False


def table(block):
    columns, rows = block["columns"], block["rows"]
    numeric = [all(len(r) <= i or r[i] == "" or is_number(r[i]) for r in rows) for i in range(len(columns))]

    def cells(row, tag):
        wide = f' colspan="{len(columns) - len(row) + 1}"' if len(row) < len(columns) else ""
        return "".join(f'<{tag}{" class=n" if numeric[i] and not (wide and i + 1 == len(row)) else ""}'
                       f'{wide if i + 1 == len(row) else ""}>{html.escape(cell)}</{tag}>' for i, cell in enumerate(row))

    body = "".join(f'<tr{" class=group" if row[0] else ""}>{cells(row, "td")}</tr>\n' for row in rows)
    return f'<div class="scroll"><table><tr>{cells(columns, "th")}</tr>\n{body}</table></div>\n'


def images(block, directory):
    figures = []
    for image in block["images"]:
        data = base64.b64encode((directory / image["file"]).read_bytes()).decode()
        caption = html.escape(image["caption"])
        figures.append(f'<figure><img alt="{caption}" src="data:image/png;base64,{data}"><figcaption>{caption}'
                       "</figcaption></figure>")
    return "\n".join(figures) + "\n"


def svg(figure):
    text = io.StringIO()
    figure.savefig(text, format="svg", bbox_inches="tight", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    plt.close(figure)
    text = text.getvalue()
    return "<figure>" + text[text.index("<svg"):] + "</figure>\n"


def axes(block):
    figure, axis = plt.subplots(figsize=(13, 4.2) if block.get("wide") else (6.2, 4.2))
    axis.set_title(block["title"], fontsize=11)
    axis.set_ylabel(block["y_label"])
    if block.get("y_log"):
        axis.set_yscale("log")
    axis.set_axisbelow(True)
    return figure, axis


def scatter(block):
    figure, axis = axes(block)
    axis.set_xlabel(block["x_label"])
    if block.get("x_log"):
        axis.set_xscale("log")
        axis.xaxis.set_major_formatter(matplotlib.ticker.FormatStrFormatter("%g"))
    series = list(dict.fromkeys(p["series"] for p in block["points"]))
    labels = list(dict.fromkeys(p["label"] for p in block["points"]))
    for p in block["points"]:
        axis.plot(p["x"], p["y"], linestyle="", marker=MARKERS[labels.index(p["label"]) % len(MARKERS)], markersize=8,
                  color=COLORS[series.index(p["series"]) % len(COLORS)], markeredgecolor="white")
    if block.get("lines"):
        for i, name in enumerate(series):
            own = sorted((p["x"], p["y"]) for p in block["points"] if p["series"] == name)
            axis.plot([x for x, _ in own], [y for _, y in own], color=COLORS[i % len(COLORS)], linewidth=1)
    handles = [matplotlib.lines.Line2D([], [], marker="s", linestyle="", color=COLORS[i % len(COLORS)], label=s)
               for i, s in enumerate(series)]
    handles += [matplotlib.lines.Line2D([], [], marker=MARKERS[i % len(MARKERS)], linestyle="", color="#868e96", label=s)
                for i, s in enumerate(labels)]
    axis.legend(handles=handles, fontsize=9, loc="center left", bbox_to_anchor=(1.0, 0.5))
    if not block.get("y_log"):
        axis.set_ylim(bottom=0)
    return svg(figure)


def bars(block):
    figure, axis = axes(block)
    count = len(block["series"])
    for i, name in enumerate(block.get("order", block["series"])):
        values = block["series"][name]
        places = [g + (i - (count - 1) / 2) * 0.8 / count for g in range(len(values))]
        axis.bar(places, [v or 0 for v in values], 0.8 / count, label=name, color=COLORS[i % len(COLORS)])
    axis.set_xticks(range(len(block["groups"])), block["groups"], rotation=20, ha="right")
    axis.grid(axis="x", visible=False)
    axis.legend(fontsize=9)
    return svg(figure)


def main(data_file, page_file):
    data = json.loads(pathlib.Path(data_file).read_text())
    directory = pathlib.Path(data_file).parent
    makers = {"table": table, "images": lambda block: images(block, directory), "scatter": scatter, "bars": bars}
    parts = [f"<h1>{html.escape(data['title'])}</h1>\n"]
    parts += [f'<p class="notes">{html.escape(note)}</p>\n' for note in data.get("notes", [])]
    for section in data["sections"]:
        parts.append(f"<h2>{html.escape(section['heading'])}</h2>\n")
        if "text" in section:
            parts.append(f"<p>{html.escape(section['text'])}</p>\n")
        parts += [makers[block["type"]](block) for block in section["blocks"]]
    pathlib.Path(page_file).write_text(f'<!DOCTYPE html>\n<html lang="en"><meta charset="utf-8">\n<title>'
                                       f'{html.escape(data["title"])}</title>\n<style>{STYLE}</style>\n'
                                       f'{"".join(parts)}</html>\n')


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2])
