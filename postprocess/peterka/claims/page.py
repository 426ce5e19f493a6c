"""The page as blocks, written out by markdown.py and html.py."""

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from .drawn_rigs import GAP_SPREAD_MM, SPREAD, Agreement
from .record import AGREES, DIFFERS, LIMITS, OPEN, SETTLED, SOME, Claim, percent
from .sensitivity import PARAMETERS, Row

SHOWN_FACTORS = (0.5, 0.75, 1.0, 1.25, 1.5, 2.0)  # of the sensitivity table


@dataclass(frozen=True)
class Heading:
    """A heading of this level, from 1."""

    level: int
    text: str


@dataclass(frozen=True)
class Paragraph:
    """A paragraph; ** and ` have their Markdown meaning."""

    text: str


@dataclass(frozen=True)
class Fields:
    """Lines, each with a name."""

    lines: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class Table:
    """A list of texts; ** and ` have their Markdown meaning."""

    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Pictures:
    """Pictures, by file name without .png."""

    names: tuple[str, ...]


Block = Heading | Paragraph | Fields | Table | Pictures


def blocks(groups: Sequence[tuple[str, Sequence[Claim]]], sensitivity_rows: Sequence[Row],
           has_picture: Callable[[str], bool], of_rigs: dict[str, Agreement]) -> list[Block]:
    """The page's blocks from groups of claims, rows of the sensitivity, a predicate telling whether a picture exists, and how many
    drawn rigs agree with each claim."""
    claims = [claim for _, group in groups for claim in group]
    out: list[Block] = [Heading(1, "The paper's claims, tested"), Paragraph(_introduction(claims)), Fields(LIMITS),
                        Paragraph(SETTLED), *_band(claims, of_rigs), _overview(claims, of_rigs)]
    shown: set[str] = set()
    for title, group in groups:
        out.append(Heading(2, title))
        for claim in group:
            out += [Heading(3, claim.says), _fields(claim, of_rigs.get(claim.key))]
        made = dict.fromkeys(name for claim in group for name in claim.pictures if has_picture(name))
        names = tuple(name for name in made if name not in shown)
        shown.update(names)
        if names:
            out.append(Pictures(names))
    return out + _sensitivity(sensitivity_rows)


def _introduction(claims: Sequence[Claim]) -> str:
    counts = Counter(claim.verdict for claim in claims)
    text = (f"Written by `jobs/paper.sh` from the files that the program computes: {len(claims)} claims of Aguiar and "
            f"Weber, in our words; {counts[AGREES]} agree, {counts[DIFFERS]} differ")
    text += f", {counts[OPEN]} not computed" if counts[OPEN] else ""
    return text + ". The model has the printed parameters, and none is tuned. Limits that verdicts go by:"


def _band(claims: Sequence[Claim], of_rigs: dict[str, Agreement]) -> list[Block]:
    """Which verdicts the errors of a measured rig may turn."""
    if not of_rigs:
        return []
    most = max(agreement.computed for agreement in of_rigs.values())
    differing = [of_rigs[claim.key] for claim in claims if claim.verdict == DIFFERS and claim.key in of_rigs]
    inside = sum(each.agree > 0 for each in differing)
    turned = sum(of_rigs[claim.key].agree < of_rigs[claim.key].computed for claim in claims
                 if claim.verdict == AGREES and claim.key in of_rigs)
    return [Paragraph(
        f"How far the rig's own errors reach: the paper prints none of ki, ci and the gaps, which calibrated shims set. The claims were "
        f"tested again for {most} rigs whose ki and ci lie within {100 * SPREAD:.0f} % of the printed ones and whose gaps within "
        f"{GAP_SPREAD_MM:g} mm of those named (a low-discrepancy sequence; the same change for all files of a rig). Of the "
        f"{len(differing)} claims that differ, {inside} agree with at least one of these rigs, so that such errors may explain them; "
        f"{len(differing) - inside} agree with none. Of those that agree, {turned} differ for at least one.")]


def _overview(claims: Sequence[Claim], of_rigs: dict[str, Agreement]) -> Table:
    header = ("claim", "place", "verdict", *["rigs drawn that agree"] * bool(of_rigs))
    return Table(header, tuple((claim.says, claim.place, _strong(claim.verdict),
                                *[str(of_rigs.get(claim.key, ""))] * bool(of_rigs)) for claim in claims))


def _strong(verdict: str) -> str:
    return verdict if verdict == AGREES else f"**{verdict}**"


def _fields(claim: Claim, of_rigs: Agreement | None) -> Fields:
    rigs = f"{of_rigs} agree" if of_rigs else ""
    lines = [("Place", claim.place), ("Computed", claim.computed), ("Verdict", _strong(claim.verdict)),
             ("By how much", claim.difference), ("Rigs drawn", rigs), ("Likely why", claim.why)]
    return Fields(tuple((name, text) for name, text in lines if text))


def _sensitivity(rows: Sequence[Row]) -> list[Block]:
    if not rows:
        return []
    factors = [factor for factor in SHOWN_FACTORS if any(factor in row.factors for row in rows)]
    header = ("number", "printed", "parameter", "would remove the difference", *(f"{factor:g} times" for factor in factors))
    table = Table(header, tuple(_sensitivity_row(row, factors) for row in rows))
    return [
        Heading(2, "Which parameter would remove a difference"),
        Paragraph("One parameter at a time is multiplied by a factor, everything else stays as printed, gaps in mm too. Only "
                  "the plane of starts, which is in A0 and A0 ω and ends at the stop, grows and shrinks with the cart's "
                  "amplitude. The column in the middle says which factor, nearest to 1, brings the number to the paper's, or, "
                  "where the paper has some starts of each kind, which of those tried has them, too (some = at least "
                  f"{percent(SOME)} of the starts of each kind); the others give the number itself, of starts the shares that "
                  "end in impacts / in none."),
        table,
    ]


def _sensitivity_row(row: Row, factors: Sequence[float]) -> tuple[str, ...]:
    values = dict(zip(row.factors.tolist(), zip(row.values.tolist(), row.quiet.tolist())))
    is_basin = row.printed is None
    printed = "some of each" if is_basin else f"{row.printed:g} {row.unit}"
    return (row.what, printed, PARAMETERS[row.parameter][2], row.answer,
            *(_value(values[factor], row.unit, is_basin) if factor in values else "" for factor in factors))


def _value(found: tuple[float, float], unit: str, is_basin: bool) -> str:
    value, quiet = found
    if is_basin:
        return f"{value:.4g} / {quiet:.4g} {unit}"
    return f"{value:.4g} {unit}" if value == value else "no band"
