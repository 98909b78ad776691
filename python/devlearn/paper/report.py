"""The report: one HTML file that needs nothing else."""

from __future__ import annotations

import base64
import html
import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ..record import written_aside
from . import schedule
from .claims import Figure, Verdict
from .figures import Drawn

_STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; color: #222; margin: 0 auto; padding: 1.5rem;
       max-width: 76rem; }
h1 { font-size: 1.6rem; } h2 { font-size: 1.25rem; margin-top: 2.5rem; }
table { border-collapse: collapse; width: 100%; font-size: 0.86rem; }
.claims td:first-child { min-width: 22rem; }
th, td { border-bottom: 1px solid #ddd; padding: 0.4rem 0.5rem; text-align: left;
         vertical-align: top; }
thead th { border-bottom: 2px solid #222; }
td.number, th.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
.scroll { overflow-x: auto; }
.measure { color: #666; font-size: 0.8rem; display: block; }
.spread { color: #666; display: block; font-size: 0.8rem; }
.yes { color: #00664b; font-weight: 600; } .no { color: #a33b00; font-weight: 600; }
figure { margin: 1.5rem 0; } figure img { max-width: 100%; height: auto; }
figcaption { color: #444; font-size: 0.9rem; max-width: 50rem; }
pre { background: #f6f6f6; padding: 1rem; overflow-x: auto; font-size: 0.8rem; }
"""


def write_report(
    path: Path,
    verdicts: Mapping[str, Sequence[Verdict]],
    drawn: Mapping[int, Sequence[Drawn]],
    statistics: Sequence[Drawn],
    table: Sequence[Sequence[Any]],
    summary: Sequence[Sequence[Any]],
    provenance: Mapping[str, Any],
    seeds: int,
    seconds: float,
) -> None:
    """Write the report to one file, with the pictures that are in ``figures`` beside it.

    Raises FileError.
    """
    folder = path.parent / "figures"
    planned = schedule.SECTION_VI
    figures = [
        f"<h2>{'Beyond the paper' if number == 0 else f'Figure {number}'}</h2>"
        + "".join(_figure(folder, figure) for figure in group)
        + (f"<h2>Table 1</h2>{_table(table)}" if number == 10 else "")
        for number, group in drawn.items()
    ]
    page = f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Sensorimotor developmental learning, reproduced</title><style>{_STYLE}</style></head><body>
<h1>Sensorimotor developmental learning from orientation and curiosity, reproduced</h1>
<p>Section VI of Zhang et al. (IEEE Access 8, 2020), computed by devlearn
{html.escape(str(provenance["devlearn"]))} (commit {html.escape(str(provenance["commit"]))}) over
{seeds} seeds, in {seconds:.0f} s. {_summary(verdicts)}</p>
<h2>The paper's claims</h2>
<p>Each criterion was written down before the first run. The control is something for which the
claim should fail; where it holds for the control too, the criterion says little. The spread is the
10th to the 90th percentile of the runs.</p>
{_claims(verdicts)}
<h2>Over all seeds</h2>
{_table(summary)}
{"".join(_figure(folder, figure) for figure in statistics)}
{"".join(figures)}
<h2>How it was made</h2>
<p>A run is two rounds of free learning of {planned.free[0]} steps, then up to
{planned.rounds} rounds of path learning, each failed after {planned.step_limit} steps;
a run ends early after {planned.hopeless} failed rounds in a row, and the rounds left out
count as failed in the statistics of steps. All numbers are in numbers.json.</p>
<pre>{html.escape(_provenance(provenance))}</pre>
</body></html>
"""
    with written_aside(path, "w") as file:
        file.write(page)


def _summary(verdicts: Mapping[str, Sequence[Verdict]]) -> str:
    return " ".join(
        f"Preset <code>{name}</code>: {sum(v.holds for v in of_preset)} of {len(of_preset)} "
        "claims hold."
        for name, of_preset in verdicts.items()
    )


def _claims(verdicts: Mapping[str, Sequence[Verdict]]) -> str:
    names = list(verdicts)
    head = "".join(
        f'<th class="number">{name}</th><th>holds</th><th class="number">control</th>'
        "<th>control holds</th>"
        for name in names
    )
    rows = []
    for row in zip(*verdicts.values()):
        claim = row[0].claim
        criterion = (
            f"{claim['aggregate']} {claim['criterion']['op']} {claim['criterion']['bound']:g}"
        )
        cells = "".join(
            _number(v.figure)
            + _yes(v.holds)
            + _number(v.control)
            + _yes(v.control_holds, good=False)
            for v in row
        )
        rows.append(
            f"<tr><td>{html.escape(claim['claim'])}"
            f'<span class="measure">{html.escape(claim["section"])}. '
            f"{html.escape(claim['measure'])} Control: {html.escape(claim['control'])}.</span></td>"
            f"<td>{html.escape(criterion)}</td>{cells}</tr>"
        )
    return (
        '<div class="scroll"><table class="claims">'
        f"<thead><tr><th>claim</th><th>criterion</th>{head}</tr></thead>"
        f"<tbody>{''.join(rows)}</tbody></table></div>"
    )


def _number(figure: Figure) -> str:
    if math.isnan(figure.value):
        return '<td class="number">not measurable</td>'
    spread = ""
    if figure.low is not None and figure.high is not None:
        spread = f'<span class="spread">{figure.low:.3g} to {figure.high:.3g}</span>'
    return f'<td class="number">{figure.value:.3g}{spread}</td>'


def _yes(holds: bool, *, good: bool = True) -> str:
    return f'<td class="{"yes" if holds == good else "no"}">{"yes" if holds else "no"}</td>'


def _figure(folder: Path, drawn: Drawn) -> str:
    data = base64.b64encode((folder / f"{drawn.name}.png").read_bytes()).decode()
    caption = html.escape(drawn.caption)
    width = round(drawn.figure.get_figwidth() * 120)
    return (
        f'<figure><img src="data:image/png;base64,{data}" width="{width}" alt="{caption}">'
        f"<figcaption>{caption}</figcaption></figure>"
    )


def _table(rows: Sequence[Sequence[Any]]) -> str:
    head, *body = rows

    def cells(row: Sequence[Any], tag: str) -> str:
        return "".join(
            f'<{tag} class="{"text" if isinstance(row[0], str) and not i else "number"}">'
            f"{html.escape(value if isinstance(value, str) else f'{value:g}')}</{tag}>"
            for i, value in enumerate(row)
        )

    lines = "".join(f"<tr>{cells(row, 'td')}</tr>" for row in body)
    return (
        f'<div class="scroll"><table><thead><tr>{cells(head, "th")}</tr></thead>'
        f"<tbody>{lines}</tbody></table></div>"
    )


def _provenance(provenance: Mapping[str, Any]) -> str:
    return json.dumps(provenance, indent=2)
