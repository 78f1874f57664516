# SPDX-License-Identifier: Apache-2.0
# markdown_pages.py FILE.md...: writes the pages to stdout in the form that Doxygen reads. The pages have formulas in the form
# that git hosts show: $...$ within a line, and ```math around lines of their own. The script turns the formulas into MathML,
# which browsers show without scripts, fonts or a network. Links lose their places (#...), because Doxygen gives the places
# other names. This script runs in the Python that has latex2mathml.
import pathlib
import re
import sys

from latex2mathml.converter import convert

FENCE = re.compile(r"^( *)```(\w*) *$")
# A formula begins behind a blank or a bracket, and ends before a blank or punctuation. Inside the dollars, a formula does not
# begin or end with a blank.
CODE = r"(`+)(?:(?!\1).)*\1(?!`)"
FORMULA = re.compile(CODE + r"|(?<![\w$\\])\$(?=[^\s$])([^$]*?)(?<=[^\s$])\$(?![\w$])")

# latex2mathml and browsers lack some of TeX's rules. There is no space around a slash, and none behind a sign. Functions have
# some space around them. Columns need a style that Chromium knows. Primes are already drawn high, so they are not
# superscripts.
THIN = '<mspace width="0.167em" />'
SPACING = [
    (r"<mi>(&#x000B1;)</mi>", r"<mo>\1</mo>"),
    (r"<mo>(&#x0002F;)</mo>", r'<mo lspace="0" rspace="0">\1</mo>'),
    (r"(&#x0002[8C];</mo>)<mo>(&#x02212;)</mo>", r'\1<mo form="prefix">\2</mo>'),
    (r"(</mi>|frac>|style>)(<mi>(?:cos|sin|cot|tan)</mi>)", r"\1" + THIN + r"\2"),
    (r"(<mi>(?:cos|sin|cot|tan)</mi>)(?=<mi>|<msub>|<mfrac>)", r"\1" + THIN),
    (r'columnalign="(\w+)"', r'style="text-align: \1"'),
    (r"<msup>(<mi>\w</mi>)<mi>(&#x0203[23];)</mi></msup>", r'\1<mo lspace="0" rspace="0">\2</mo>'),
]


def mathml(formula, display, place):
    # Bars are brackets here, not operators with space around them.
    formula = formula.replace(r"\lvert", r"\left\lvert").replace(r"\rvert", r"\right\rvert")
    text = convert(formula, display="block" if display else "inline")
    if re.search(r"\\|&(?!#)", text):
        sys.exit(f"markdown_pages.py: {place}: what is {formula.strip()}? latex2mathml makes {text}")
    text = re.sub(r' xmlns="[^"]*"', "", text)
    for pattern, replacement in SPACING:
        text = re.sub(pattern, replacement, text)
    # Doxygen's Markdown would interpret these characters.
    return re.sub(r">([^<]*)<", lambda found: ">" + re.sub(r"[*_`|~]", lambda c: f"&#{ord(c[0])};", found[1]) + "<", text)


def inline(line, place):
    def formula(found):
        if found[1]:
            return found[0]  # code
        return f"@htmlonly{mathml(found[2], False, place)}@endhtmlonly"

    line = re.sub(r"\]\((\.\./)+", "](", line)  # the pages of docs and docs/theory lie beside the others
    line = re.sub(r"<!--(=[\w.]+|/)-->", "", line)  # marks of numbers that a program writes
    return re.sub(r"[.]md#[a-z0-9-]*", ".md", FORMULA.sub(formula, line))


def page(path):
    fence, formula = None, None
    text = pathlib.Path(path).read_text(encoding="utf-8")
    # Doxygen resolves neither a link within the page nor a link whose words stand on two lines.
    text = re.sub(r"\[([^\]]*)\]\(#[\w-]*\)", r"\1", text)
    text = re.sub(r"\[([^\]]*)\n *([^\]\n]*\]\([^)\s]+\)\S*)", r"[\1 \2\n", text)
    for number, line in enumerate(text.splitlines(), 1):
        place = f"{path}:{number}"
        found = FENCE.match(line)
        if fence is None and found:
            fence = found
            formula = [] if fence[2] == "math" else None
            if formula is None:
                yield line
        elif fence is not None and found and not found[2]:
            yield line if formula is None else f"{fence[1]}@htmlonly{mathml(' '.join(formula), True, place)}@endhtmlonly"
            fence, formula = None, None
        elif fence is not None:
            if formula is None:
                yield line
            else:
                formula.append(line)
        else:
            yield inline(line, place)
    if fence is not None:
        sys.exit(f"markdown_pages.py: {path}: a fence has no end")


for path in sys.argv[1:]:
    print("\n".join(page(path)))
