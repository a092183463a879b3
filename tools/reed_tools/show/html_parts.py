"""What every page is made of: one file, readable without a network and in print."""

import base64
import html
from pathlib import Path
from urllib.parse import quote

STYLE = """
body{font:15px/1.45 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;color:#222}
h1{font-size:1.5rem;margin-bottom:0} h2{font-size:1.1rem;margin-top:2rem;border-bottom:1px solid #ccc}
table{border-collapse:collapse;margin:.6rem 0;display:block;overflow-x:auto}
th,td{padding:.15rem .8rem .15rem 0;text-align:right;border-bottom:1px solid #eee;vertical-align:top} td{white-space:nowrap}
th:first-child,td:first-child,th.text,td.text{text-align:left} th[colspan]{text-align:center;border-bottom:none} td.text:last-child{white-space:normal;min-width:9rem} th{font-weight:600}
.raw a{margin-right:1rem;white-space:nowrap} footer{margin-top:2.5rem;border-top:1px solid #ccc;padding-top:.5rem;font-size:13px;color:#555}
figure{margin:.6rem 0} figcaption{color:#555;font-size:13px}
.pass{color:#00703c}.fail{color:#b00020} img{width:100%;margin:.6rem 0} pre{white-space:pre-wrap;font-size:12px;background:#f6f6f6;padding:.8rem}
@media print{body{max-width:none;margin:0;font-size:10.5pt} table{display:table;font-size:9pt} td{white-space:normal} figure,img,tr{break-inside:avoid} h2{break-after:avoid} a{color:inherit;text-decoration:none} pre{font-size:8pt} pre.long{columns:2}}
"""


class Markup(str):
    """Text that is HTML already; everything else is escaped where a table takes it."""


def page(title: str, body: str, head: str = "", scripts: str = "") -> str:
    """A whole document; `title` and everything else is HTML already."""
    return (f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>Reed: {title}</title>'
            f"<style>{STYLE}</style>{head}</head><body>\n{body}\n{scripts}</body></html>\n")


def again(command: str | None, raw: list[str], versions: dict | None = None, machine: dict | None = None) -> str:
    """At the end of every page: how to make it again, with what it was made, and the files that it is made from, beside it."""
    versions, machine = versions or {}, machine or {}
    what = [f"Reed {versions['reed']}" if versions.get("reed") else "", f"commit {versions['commit']}" if versions.get("commit") else "",
            f"programs {versions['build']}" if versions.get("build") else "",
            f"law file {versions['law']}" if versions.get("law") else "",
            f"{machine['cpu']}, {machine['cores']} cores, kernel {machine['kernel']}" if machine.get("cpu") else ""]
    shown = f"<pre>{html.escape(command)}</pre>" if command else ""
    links = " ".join(f'<a href="{html.escape(quote(name))}">{html.escape(name)}</a>' for name in raw)
    return (f"{shown}<p>{html.escape('; '.join(word for word in what if word))}</p>"
            f'{f"<p class=raw>Raw data, beside this page: {links}</p>" if links else ""}')


def table(head: list[str], rows: list[list], text: tuple[int, ...] = (), groups: list[tuple[str, int]] = []) -> str:
    """Numbers stay on one line; columns `text` hold sentences, which may wrap. `groups`: heads above so many columns each."""
    def cells(tag: str, values: list) -> str:
        return "".join(f"<{tag}{' class=text' if k in text else ''}>{value if isinstance(value, Markup) else html.escape(str(value))}</{tag}>"
                       for k, value in enumerate(values))

    body = "\n".join(f"<tr>{cells('td', row)}</tr>" for row in rows)
    above = f"<tr>{''.join(f'<th colspan={count}>{title}</th>' for title, count in groups)}</tr>" if groups else ""
    return f"<table><thead>{above}<tr>{cells('th', head)}</tr></thead><tbody>\n{body}\n</tbody></table>"


def mark(ok: bool) -> Markup:
    return Markup('<span class="pass">ok</span>' if ok else '<span class="fail"><b>FAIL</b></span>')


def picture(path: Path, caption: str) -> str:
    data = base64.b64encode(path.read_bytes()).decode()
    return f'<figure><img alt="{html.escape(caption)}" src="data:image/png;base64,{data}"><figcaption>{html.escape(caption)}</figcaption></figure>'
