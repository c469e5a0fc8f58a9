"""The explorer as a part of a page: its form, and the numbers of the first contact, computed when the site is built."""

import json
from collections.abc import Iterator
from html import escape
from pathlib import Path
from typing import Any, NamedTuple

from explore import QUESTIONS, curve, explore, materials

HERE = Path(__file__).parent / "explorer"
FIRST = {"material": "quartz", "radius": "100nm", "speed": "20cm/s"}


class Slider(NamedTuple):
    """An input with a box and a slider, whose ends and step are exponents of ten, except for the load."""

    word: str
    label: str
    low: float
    high: float
    step: float
    unit: str


SLIDERS = (
    Slider("radius", "radius <i>R</i><sub>1</sub>", -9, -3, 0.02, "m"),
    Slider("radius2", "radius <i>R</i><sub>2</sub>", -9, -3, 0.02, "m"),
    Slider("gamma", "surface energy <i>γ</i>", -3, 1, 0.02, "J/m2"),
    Slider("young", "Young’s modulus <i>E</i>", 5, 12.2, 0.02, "Pa"),
    Slider("load", "load <i>P</i>", -1.1, 1.7, 0.01, "N"),  # linear, in units of the pull-off force
    Slider("xi", "rolling lag <i>ξ</i>", -11, -7.5, 0.02, "m"),
    Slider("speed", "impact speed <i>v</i>", -3, 2, 0.02, "m/s"),
)
LAWS = {"": "best of all", "jkr": "JKR alone", "maugis": "Maugis alone", "dmt": "DMT alone"}


def explorer() -> str:
    """Return the explorer as HTML, with the first contact's numbers in it."""
    first = json.loads(explore(json.dumps(FIRST)))
    first["curve"] = json.loads(curve(json.dumps(FIRST)))["lines"]
    parts = {
        "menus": "\n".join(_menus()),
        "sliders": "\n".join(_slider(slider, first) for slider in SLIDERS),
        "cards": "\n".join(_cards(first["results"])),
        "why": "".join(f"<li><b>{escape(by)}</b>: {escape(text)}</li>" for by, text in first["why"].items()),
        "poisson": first["inputs"]["poisson"]["text"],
        "density": first["inputs"]["density"]["text"],
        "shell": escape(first["shell"]),
        "python": escape(first["python"]),
        "first": json.dumps(first, ensure_ascii=False).replace("</", "<\\/"),
    }
    text = (HERE / "explorer.html").read_text(encoding="utf-8")
    for name, part in parts.items():
        text = text.replace(f"<!--{name}-->", part)
    return text


def _menus() -> Iterator[str]:
    groups = ""
    for title, names in materials():
        options = "".join(f"<option>{escape(name)}</option>" for name in names)
        groups += f'<optgroup label="{escape(title)}">{options}</optgroup>'
    chosen = groups.replace("<option>quartz<", "<option selected>quartz<")
    laws = "".join(f'<option value="{name}">{words}</option>' for name, words in LAWS.items())
    yield _menu("material", "solid of sphere 1", f'{chosen}<option value="">my own: γ, E, ν, ρ</option>')
    yield _menu("material2", "solid of sphere 2", f'<option value="">like sphere 1</option>{groups}')
    yield _menu("model", "law of attraction", laws)


def _menu(word: str, label: str, options: str) -> str:
    return f'<div class="row menu"><label for="{word}">{label}</label><select id="{word}">{options}</select></div>'


def _slider(slider: Slider, first: dict[str, Any]) -> str:
    word, low, high, step = slider.word, slider.low, slider.high, slider.step
    value, placeholder = FIRST.get(word, ""), first["inputs"][word]["text"]
    plane = '<label class="check"><input type="checkbox" id="plane"> a plane</label>' if word == "radius2" else ""
    return f"""<div class="row"><label for="{word}">{slider.label}</label>
<input id="{word}" value="{value}" placeholder="{placeholder}" spellcheck="false" autocapitalize="off">
<input type="range" data-of="{word}" data-unit="{slider.unit}" min="{low}" max="{high}" step="{step}"
 aria-label="{word}, slider">{plane}</div>"""


def _cards(results: dict[str, Any]) -> Iterator[str]:
    """Iterate over a card for each question, with a line for each of its results."""
    for question, names in QUESTIONS.items():
        rows = "".join(_result(name, results[name]) for name in names)
        yield f'<li><span class="question">{question}</span>{rows}</li>'


def _result(name: str, result: dict[str, str]) -> str:
    symbol, _, foot = result["symbol"].partition("_")
    sign = f"<i>{symbol}<sub>{foot}</sub></i>" if foot else f"<i>{symbol}</i>"
    below = f"{escape(result['by'])} · {result['law']} alone {escape(result['value'])}"
    return (
        f'<output data-result="{name}" title="{escape(result["quantity"])}">{sign} <b>{escape(result["best"])}</b>'
        f"<small>{below}</small></output>"
    )
