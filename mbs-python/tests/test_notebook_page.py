"""The page of a result stands alone."""

from __future__ import annotations

import pickle
import re
from html import unescape

import multibody as mbs
import pytest
from conftest import scene

LOADED = re.compile(r"""(?:src|href)\s*=\s*["']?(?!data:|#)[a-z]+://|@import|url\(\s*["']?http|fetch\(|import\s*\(""", re.IGNORECASE)
"""What would load something else."""


@pytest.fixture(scope="module")
def result() -> mbs.Result:
    return mbs.Mechanism(scene("double-pendulum")).run(0.5)


def test_a_page_is_whole_and_loads_nothing(result: mbs.Result) -> None:
    page = result.page()
    assert page.lower().startswith("<!doctype html>")
    assert page.rstrip().endswith("</html>") or "id" in page[-200:]
    assert not LOADED.search(page)
    assert "double pendulum" in page


def test_a_notebook_shows_the_page_in_a_frame(result: mbs.Result) -> None:
    frame = result._repr_html_()
    match = re.fullmatch(r'<iframe srcdoc="([^"]*)"[^>]*></iframe>', frame)
    assert match
    assert unescape(match[1]) == result.page()


def test_a_result_from_another_process_has_its_page(result: mbs.Result) -> None:
    page = pickle.loads(pickle.dumps(result)).page()
    assert page.lower().startswith("<!doctype html>")
    assert not LOADED.search(page)
