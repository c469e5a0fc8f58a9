"""Search by words, as in a question: common words are left out, rare words and phrases count most."""

import re
from collections.abc import Callable, Iterable, Sequence
from functools import cache
from itertools import pairwise, product
from math import log
from typing import Generic, NamedTuple, TypeVar

from ..text import ascii_text

COMMON = frozenset(
    "a about all an and any are as at be by calculate can compute could define definition describe did do does "
    "explain find for from get give happens have how i if in include includes into is it its know many me mean meaning "
    "means much must my need of on or please program should show so such tell than that the their them then there "
    "these they this those to use want was we what when where which who why will with would you your".split()
)
LONG = 60  # words of a text from which on one of them counts for less
PREFIX = 0.5  # worth of a longer word with the same beginning, against another form of the word

Thing = TypeVar("Thing")
Field = tuple[float, str]  # the weight of a text by which a thing is found, and this text


class Found(NamedTuple, Generic[Thing]):
    """A thing that has words that are sought."""

    thing: Thing
    score: float
    has_all: bool  # of the words


def words_in(text: str) -> list[str]:
    """Return the words and numbers of a text in lower case, with Greek letters and units spelt out.

    >>> words_in("ξ of R_min, 0.2 nm or 2Å")
    ['xi', 'of', 'r', 'min', '0.2', 'nm', 'or', '2', 'angstrom']
    """
    return re.findall(r"\d+(?:\.\d+)+|[^\W_]+", ascii_text(text).casefold())


def words_sought(text: str) -> list[str]:
    """Return the words of a question that are not common, or all if there are no others.

    >>> words_sought("What does fixed grips mean?"), words_sought("why")
    (['fixed', 'grips'], ['why'])
    """
    words = words_in(text)
    return [*dict.fromkeys(word for word in words if word not in COMMON)] or [*dict.fromkeys(words)]


@cache
def stem(word: str) -> str:
    """Return a word without its ending.

    >>> [stem(word) for word in ("grips", "humidity", "roughness", "capillaries", "bouncing", "menisci", "speed")]
    ['grip', 'humid', 'rough', 'capillar', 'bounc', 'menisc', 'speed']
    """
    endings = r"(?<=\w{4})(iness|ness|ities|ity|ies|ing|(?<!e)ed|es|us|i|y|e)$|(?<=\w{2}[^su])s$"
    return re.sub(endings, "", word)


def nearness(word: str, other: str) -> float:
    """Return how near a word of a text is to one that is sought: 1 for the word and its forms, 0 for another.

    >>> [nearness("humidity", other) for other in ("humid", "humidifier", "hum")], nearness("xi", "xia")
    ([1.0, 0.5, 0.0], 0.0)
    """
    if other == word or stem(other) == stem(word):
        return 1.0
    return PREFIX if len(stem(word)) > 2 and other.startswith(stem(word)) else 0.0


class Search(Generic[Thing]):
    """Things, and the words by which they are found."""

    def __init__(self, things: Iterable[Thing], fields_of: Callable[[Thing], Iterable[Field]]) -> None:
        self._things = [(thing, [(weight, words_in(text)) for weight, text in fields_of(thing)]) for thing in things]
        self.vocabulary = {word for _, fields in self._things for _, text in fields for word in text}

    def knows(self, word: str) -> bool:
        """Return whether a word, or one like it, stands in some field."""
        return any(nearness(word, other) for other in self.vocabulary)

    def ranked(self, words: Sequence[str]) -> list[Found[Thing]]:
        """Return the things that have some of the words, the best first."""
        if not words:
            return []
        forms = {other: {word: near for word in words if (near := nearness(word, other))} for other in self.vocabulary}
        having = [{word for _, text in fields for other in text for word in forms[other]} for _, fields in self._things]
        rarity = {word: log(1 + len(having) / (1 + sum(word in has for has in having))) for word in words}

        def worth(text: Sequence[str]) -> float:
            """Return what the words in a text are worth, and again for those that stand beside each other."""
            places = [forms[other] for other in text]
            single = sum(rarity[word] * max(place.get(word, 0.0) for place in places) for word in words)
            phrases = {pair for neighbours in pairwise(places) for pair in product(*neighbours)}
            return single + sum(rarity[word] for pair in phrases.intersection(pairwise(words)) for word in pair)

        found = []
        for (thing, fields), has in zip(self._things, having, strict=True):
            score = sum(weight * worth(text) / (1 + len(text) / LONG) for weight, text in fields if text and has)
            found.append(Found(thing, score * (len(has) / len(words)) ** 2, len(has) == len(words)))
        return sorted((each for each in found if each.score), key=lambda each: each.score, reverse=True)
