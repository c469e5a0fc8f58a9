"""The words and notations of uncertainties in headers. `statistic_rows` has the names of statistics in rows."""

# Words of columns that count, such as N or number of samples.
COUNTS = {*"n no nr num number count counts of samples measurements values replicates anzahl".split()}
# Words for a side of an uncertainty, or for an end of a range.
PARTS = {
    "minus": "minus",
    "plus": "plus",
    **dict.fromkeys(("min", "low", "lower"), "low"),
    **dict.fromkeys(("max", "high", "upper"), "high"),
}
# Notations of an uncertainty in a header. Few tables need these patterns, so they are compiled on first use.
PERCENT = r"(?i)(?<![\d\s_.,/])[\s_.,/]*[\[(]?(?:%|percent|pct)(?![a-z])[\])]?"  # a percentage of the value
# The same in an uncertainty that is not read, also after a number.
SHARE = r"(?i)[\s_.,/]*[\[(]?(?:%|percent|pct)[\])]?"
LEVEL = r"\d\s*(?:%|percent|pct)"  # a confidence level
# The coverage factor of an expanded uncertainty.
COVERAGE = r"(?i)[\s,;_]*[\[(]?\s*(?<![^\W_])k\s*=\s*(\d+(?:[.,]\d+)?)\s*[\])]?"
EXPANDED = r"^U(?![^\W_])|(?i:expanded|erweiterte|elargie)"
_ERROR = "|".join([
    r"(?:standard|std?)[\s_.]*(?:dev(?:iation)?|err(?:or)?|unc(?:ertainty)?)\.?",
    r"(?:(?:expanded|erweiterte)[\s_.]+)?(?:uncertainty|unsicherheit)", r"incertitude(?:[\s_.]+elargie)?",
    r"(?:ecart|erreur)[\s_.-]*type", r"s\.\s?d\.", r"stabw(?:\.[sn])?\.?",
    r"desv(?:iacion)?[\s_.]*(?:est(?:andar)?|tip(?:ica)?)\.?", r"dev(?:iazione)?[\s_.]*st(?:andard)?\.?",
    *"""stderror standardabweichung standardfehler messunsicherheit messfehler fehler erreur error err stdev std sd sem
        se unc""".split(),
])  # fmt: skip
RELATIVE = rf"rsd|cv|coefficient[\s_.]of[\s_.]variation|rel(?:ative|\.)?[\s_.]+(?:{_ERROR})"  # only with %
OF = "(?:of|von|de|sur)"
PART = (
    rf"(?i)^(?:u|σ|sigma)\s*\(([^()]+)\)|^(?:±|\+/?-)|^(?:σ|sigma|{RELATIVE}|{_ERROR})(?:\s+{OF})?(?=$|[\s_(\[])"
    rf"|[\s_.]*(?:±|\+/?-)(?=$|[\s_.,/(\[])|[\s_.]+(?:{RELATIVE}|{_ERROR}|{'|'.join(PARTS)})(?=$|[\s_.,/(\[])"
)
# Other words for a spread; words that mean a spread only next to a value; and words that accompany words for a spread.
_SPREADS = "errors errm errp errorbar plusminus stdv dev deviation uncert sigma var variance ci iqr mad rmse".split()
_SPREADS_BESIDE = """change difference lo hi minimum maximum neg pos confidence limit limits bound bounds range spread
    scatter tolerance tol accuracy precision resolution residual rms quartile quantile percentile noise
    fluctuation halfwidth half conf""".split()
_FILLERS = """of von de sur the rel relative delta standard expanded coverage credible interval level full width fit
    th u mean median stat statistical syst systematic sys combined total bar bars""".split()
_SPREAD = "|".join([RELATIVE, _ERROR, *_SPREADS, *PARTS])
_LETTER = r"[^\W\d_]"
SPREAD = (
    rf"(?i)(?:(?<![^\W_])\d+(?:\s*[*·×])?\s*)?(?:(?<!{_LETTER})(?:{_SPREAD})(?!{_LETTER})|(?<!{_LETTER})(?:{_SPREAD})"
    rf"|(?:{_SPREAD})(?!{_LETTER}))\d*|\d+(?:\.\d+)?\s*(?:%|percent|pct|σ)|[±σ]|\+/?-"
)
SPREAD_BESIDE = rf"(?i)(?<!{_LETTER})(?:{'|'.join(_SPREADS_BESIDE)}|[qp]\d+)(?!{_LETTER})"
FILLER = rf"(?i)(?<!{_LETTER})(?:{'|'.join(_FILLERS)})(?!{_LETTER})|(?<![^\W_])k\s*=\s*[\d.,]+"
# A prefix that usually marks the uncertainty of a symbol.
DIFFERENCE = rf"^(?:(?i:delta|d|u)(?=[\s_(])|[Δδ](?=[\s_(]*{_LETTER})|d(?={_LETTER}))"
