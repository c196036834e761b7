"""The page on faults says what the catalogue says."""

from pathlib import Path

from hil.view.faults import as_markdown, as_rows, as_text

PAGE = Path(__file__).parents[2] / "docs" / "faults.md"


def test_the_page_has_the_catalogue_as_it_is():
    _, _, rest = PAGE.read_text(encoding="utf-8").partition("<!-- catalogue -->\n")
    assert rest.partition("<!-- end -->")[0] == as_markdown()


def test_every_form_of_the_catalogue_has_every_fault():
    assert len(as_rows()) == 52
    assert as_text().count("seen by: ") == 52
