"""Search by the words of a question: common words are ignored; rare words and phrases count most."""

import re
from collections.abc import Callable, Iterable, Sequence
from functools import cache
from itertools import chain, pairwise, product
from math import log
from typing import Generic, NamedTuple, TypeVar

from ..text import ascii_text

COMMON = frozenset(
    "a about all an and any are as at be by calculate can compute could define definition describe did do does "
    "explain find for from get give happens have how i if in include includes into is it its know many me mean meaning "
    "means much must my need of on or please program should show so such tell than that the their them then there "
    "these they this those to use want was we what when where which who why will with would you your".split()
)
LONG = 60  # in texts with more words, each of them counts less
PREFIX = 0.5  # weight of a longer word with the same prefix, relative to other forms of the word

Thing = TypeVar("Thing")
Field = tuple[float, str]  # a text by which a thing is found, after its weight


class Found(NamedTuple, Generic[Thing]):
    """A thing with some of the words in a search."""

    thing: Thing
    score: float
    has_all: bool  # it has all of the words


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
    uncommon = [word for word in words if word not in COMMON]
    return [*dict.fromkeys(uncommon or words)]


@cache
def stem(word: str) -> str:
    """Return a word without its ending.

    >>> [stem(word) for word in ("grips", "humidity", "roughness", "capillaries", "bouncing", "menisci", "speed")]
    ['grip', 'humid', 'rough', 'capillar', 'bounc', 'menisc', 'speed']
    """
    endings = r"(?<=\w{4})(iness|ness|ities|ity|ies|ing|(?<!e)ed|es|us|i|y|e)$|(?<=\w{2}[^su])s$"
    return re.sub(endings, "", word)


def nearness(word: str, other: str) -> float:
    """Return how well a word of a text matches a word in a search: 1 for the word and its forms, 0 for no match.

    >>> [nearness("humidity", other) for other in ("humid", "humidifier", "hum")], nearness("xi", "xia")
    ([1.0, 0.5, 0.0], 0.0)
    """
    if other == word or stem(other) == stem(word):
        return 1.0
    return PREFIX if len(stem(word)) > 2 and other.startswith(stem(word)) else 0.0


class Search(Generic[Thing]):
    """Things, and the words by which they are found."""

    def __init__(self, things: Iterable[Thing], fields_of: Callable[[Thing], Iterable[Field]]) -> None:
        self._things: list[tuple[Thing, list[tuple[float, list[str]]]]] = []
        self.vocabulary: set[str] = set()
        for thing in things:
            fields = [(weight, words_in(text)) for weight, text in fields_of(thing)]
            self._things.append((thing, fields))
            self.vocabulary.update(*(text for _, text in fields))

    def knows(self, word: str) -> bool:
        """Return whether a word, or one that matches it, occurs in some field."""
        return any(nearness(word, other) for other in self.vocabulary)

    def ranked(self, words: Sequence[str]) -> list[Found[Thing]]:
        """Return the things with some of the words, the best first."""
        if not words:
            return []
        matches: dict[str, dict[str, float]] = {}
        for other in self.vocabulary:
            near = {word: nearness(word, other) for word in words}
            matches[other] = {word: value for word, value in near.items() if value}
        having = []
        for _, fields in self._things:
            texts = chain.from_iterable(text for _, text in fields)
            having.append({*chain.from_iterable(matches[other] for other in texts)})
        rarity = {word: log(1 + len(having) / (1 + sum(word in has for has in having))) for word in words}

        def weight_of(text: Sequence[str]) -> float:
            """Return the weight of the words in a text; adjacent words of the question count again."""
            of_words = [matches[other] for other in text]
            single = sum(rarity[word] * max(match.get(word, 0.0) for match in of_words) for word in words)
            pairs = {*chain.from_iterable(product(*neighbours) for neighbours in pairwise(of_words))}
            phrases = pairs.intersection(pairwise(words))
            return single + sum(rarity[first] + rarity[second] for first, second in phrases)

        found = []
        for (thing, fields), has in zip(self._things, having, strict=True):
            score = 0.0
            for weight, text in fields if has else ():
                if text:
                    score += weight * weight_of(text) / (1 + len(text) / LONG)
            if score:
                found.append(Found(thing, score * (len(has) / len(words)) ** 2, len(has) == len(words)))
        return sorted(found, key=lambda each: each.score, reverse=True)
