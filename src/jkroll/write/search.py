"""Search by the words of a question: common words are ignored; rare words and phrases count most."""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache
from itertools import chain, pairwise, product
from math import log
from operator import attrgetter
from typing import Generic, NamedTuple, TypeVar

from ..text import ascii_text

COMMON = frozenset(
    "a about all an and any are as at be by calculate can compute could define definition describe did do does "
    "explain find for from get give happens have how i if in include includes into is it its know many me mean meaning "
    "means much must my need of on or please program should show so such tell than that the their them then there "
    "these they this those to use want was we what when where which who why will with would you your".split()
)
LONG = 60  # words; the score of a text of this length is halved, since a word counts less in a longer text
PREFIX = 0.5  # weight of a longer word that begins with the stem of the word sought

Thing = TypeVar("Thing")
Field = tuple[float, str]  # a weight, and a text by which a thing is found


class Match(NamedTuple, Generic[Thing]):
    """A thing that has some words of a search."""

    thing: Thing
    score: float
    has_all: bool  # the thing has all words


@cache
def words_in(text: str) -> tuple[str, ...]:
    """Return the words and numbers of a text in lower case, with Greek letters, and signs such as Å, as words.

    >>> words_in("ξ of R_min, 0.2 nm or 2Å")
    ('xi', 'of', 'r', 'min', '0.2', 'nm', 'or', '2', 'angstrom')
    """
    return tuple(re.findall(r"\d+(?:\.\d+)+|[^\W_]+", ascii_text(text).casefold()))


def words_sought(text: str) -> list[str]:
    """Return the words of a question that are not common; if all are common, return all words.

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
    """Return how well a word sought matches a word of a text: 1 for the word and its forms, 0 for no match.

    A longer word that begins with the stem of the word sought gives PREFIX.

    >>> [nearness("humidity", other) for other in ("humid", "humidifier", "hum")], nearness("xi", "xia")
    ([1.0, 0.5, 0.0], 0.0)
    """
    if other == word or stem(other) == stem(word):
        return 1.0
    return PREFIX if len(stem(word)) > 2 and other.startswith(stem(word)) else 0.0


class Search(Generic[Thing]):
    """The things that can be found, with the words of their fields."""

    def __init__(self, things: Iterable[Thing], fields_of: Callable[[Thing], Iterable[Field]]) -> None:
        self._things: list[tuple[Thing, list[tuple[float, Sequence[str]]]]] = []
        self.vocabulary: set[str] = set()
        for thing in things:
            fields: list[tuple[float, Sequence[str]]] = []
            for weight, text in fields_of(thing):
                words = words_in(text)
                fields.append((weight, words))
                self.vocabulary.update(words)
            self._things.append((thing, fields))

    def knows(self, word: str) -> bool:
        """Return whether a word, or one that matches it, occurs in some field."""
        return any(nearness(word, other) for other in self.vocabulary)

    def with_all(self, words: Sequence[str]) -> list[Thing]:
        """Return the things that have all words, the best first."""
        return [match.thing for match in self.ranked(words) if match.has_all]

    def ranked(self, words: Sequence[str]) -> list[Match[Thing]]:
        """Return the things that have some of the words, the best first."""
        if not words:
            return []
        near: dict[str, dict[str, float]] = {}  # by word of the vocabulary: the words sought that match it
        for other in self.vocabulary:
            of_words = {word: nearness(word, other) for word in words}
            near[other] = {word: value for word, value in of_words.items() if value}
        matched: list[set[str]] = []  # the words that each thing has
        for _, fields in self._things:
            of_thing: set[str] = set()
            for _, text in fields:
                of_thing.update(*(near[other] for other in text))
            matched.append(of_thing)
        rarity = {}
        for word in words:
            number = sum(word in of_thing for of_thing in matched)
            rarity[word] = log(1 + len(matched) / (1 + number))
        matches = []
        for (thing, fields), of_thing in zip(self._things, matched, strict=True):
            if not of_thing:
                continue
            score = 0.0
            for weight, text in fields:
                if text:
                    of_text = _weight_of(words, [near[other] for other in text], rarity)
                    score += weight * of_text / (1 + len(text) / LONG)
            if score:
                share = len(of_thing) / len(words)
                matches.append(Match(thing, score * share**2, has_all=share == 1))
        return sorted(matches, key=attrgetter("score"), reverse=True)


def _weight_of(words: Sequence[str], text: Sequence[Mapping[str, float]], rarity: Mapping[str, float]) -> float:
    """Return the weight of words in a text; words that are adjacent in the question and in the text count twice.

    `text`: for each word of the text the words sought that match it, with their nearness.
    """
    weight = 0.0
    for word in words:
        weight += rarity[word] * max(near.get(word, 0.0) for near in text)
    pairs = {*chain.from_iterable(product(first, second) for first, second in pairwise(text))}
    for first, second in pairs.intersection(pairwise(words)):
        weight += rarity[first] + rarity[second]
    return weight
