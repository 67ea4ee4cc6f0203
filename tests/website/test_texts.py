"""What maintainers set for their site: title, address and logo."""

from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from leaderboard.errors import InstanceError
from leaderboard.instance import Instance
from leaderboard.website import build_site
from leaderboard.website.texts import NO_TEXTS, Logo, load_texts
from site_builders import folder_files, html_files, parse_html, text_of, write_instance

LOGO = b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1 1"><script>alert(1)</script></svg>'
SETTINGS = 'title = "Who sees <b>it</b>"\nurl = "https://example.org/board/"\nlogo = "mark.svg"\n'


def write_settings(root: Path, text: str) -> Instance:
    instance = Instance(root)
    instance.site_dir.mkdir(parents=True, exist_ok=True)
    instance.site_file.write_text(text, encoding="utf-8")
    return instance


@pytest.fixture(scope="module")
def set_files(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """Build a site for which everything is set."""
    instance = write_settings(write_instance(tmp_path_factory.mktemp("set") / "instance").root, SETTINGS)
    instance.content_file("mark.svg").parent.mkdir()
    instance.content_file("mark.svg").write_bytes(LOGO)
    return folder_files(build_site(instance).path)


def test_everything_may_be_left_out(tmp_path: Path) -> None:
    """Without the file, and with an empty one, nothing is set."""
    assert load_texts(Instance(tmp_path)) == NO_TEXTS
    assert load_texts(write_settings(tmp_path, "")) == NO_TEXTS


def test_the_title_is_that_of_every_page_and_of_the_feed(set_files: dict[str, bytes]) -> None:
    """As text, in the head, beside the navigation and in the news."""
    for path, page in html_files(set_files):
        assert " \N{EN DASH} Who sees <b>it</b> (synthetic)" in text_of(next(page.iter("title"))), path
        (brand,) = [link for link in page.iter("a") if link.get("class") == "brand"]
        assert text_of(brand) == "Who sees <b>it</b>"
    feed = ET.fromstring(set_files["feed.xml"])  # noqa: S314 - our own output
    assert feed.findtext("{http://www.w3.org/2005/Atom}title") == "Who sees <b>it</b> (synthetic)"


def test_the_logo_is_a_picture_beside_the_title(set_files: dict[str, bytes]) -> None:
    """Its bytes as they are, under a name of their own; as a picture, it runs nothing."""
    (path,) = [path for path in set_files if path.startswith("assets/mark.")]
    assert set_files[path] == LOGO
    page = parse_html(set_files["method.html"])
    assert [picture.get("src") for picture in page.iter("img")] == [path]
    assert [picture.get("alt") for picture in page.iter("img")] == [""]


def test_the_address_is_in_the_feed_and_the_badges(set_files: dict[str, bytes]) -> None:
    """Where it is known, nobody has to put it in."""
    site = "https://example.org/board/"
    feed = ET.fromstring(set_files["feed.xml"])  # noqa: S314 - our own output
    links = [link.get("href", "") for link in feed.iter("{http://www.w3.org/2005/Atom}link")]
    assert len(links) > 2
    assert all(link.startswith(site) and link.removeprefix(site) in set_files for link in links)
    page = text_of(parse_html(set_files["submissions/good/index.html"]))
    assert f"]({site}submissions/good/index.html)" in page
    assert "the address of this site" not in page


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("title = ", r"site/site\.toml is not TOML: Invalid value \(at end of document\)"),
        ("titel = 'x'", r"site/site\.toml: titel: is not a known key"),
        ("title = '  '", r"site/site\.toml: title: "),
        ("title = " + "[" * 50_000, r"site/site\.toml is nested too deeply"),
        ("url = 'https://example.org'", r"site/site\.toml: url: must be an address with a slash at the end"),
        ("url = 'http:////'", r"site/site\.toml: url: "),
        ("url = 'https://example.org/a/../b/'", r"site/site\.toml: url: "),
        ("url = 'javascript:alert(1)/'", r"site/site\.toml: url: "),
        ("url = 'https://example.org/\"><script>/'", r"site/site\.toml: url: "),
        ("logo = '../../etc/passwd.png'", r"site/site\.toml: logo: "),
        ("logo = 'mark.html'", r"site/site\.toml: logo: must be the name of an \.svg or \.png file"),
        ("logo = 'mark.svg'", r"site/content/mark\.svg is not there"),
    ],
)
def test_what_cannot_be_meant_stops_the_build(tmp_path: Path, text: str, message: str) -> None:
    """With the file, the key and what is wrong with it."""
    with pytest.raises(InstanceError, match=message) as caught:
        load_texts(write_settings(tmp_path, text))
    assert caught.value.hint


def test_a_logo_that_is_a_link_is_not_followed(tmp_path: Path) -> None:
    """It could be any file of the machine."""
    instance = write_settings(tmp_path, "logo = 'mark.png'")
    instance.content_file("x").parent.mkdir()
    (tmp_path / "secret").write_bytes(b"secret")
    instance.content_file("mark.png").symlink_to(tmp_path / "secret")
    with pytest.raises(InstanceError, match=r"site/content/mark\.png cannot be read"):
        load_texts(instance)


def test_a_link_that_leads_nowhere_is_not_overlooked(tmp_path: Path) -> None:
    """What it should lead to is missed by somebody."""
    instance = Instance(tmp_path)
    instance.site_dir.mkdir()
    instance.site_file.symlink_to(tmp_path / "gone.toml")
    with pytest.raises(InstanceError, match=r"site/site\.toml cannot be read"):
        load_texts(instance)


def test_a_logo_keeps_its_name_and_bytes(tmp_path: Path) -> None:
    """Whatever they are."""
    instance = write_settings(tmp_path, "logo = 'Mark_1.png'")
    instance.content_file("x").parent.mkdir()
    instance.content_file("Mark_1.png").write_bytes(b"\x89PNG")
    assert load_texts(instance).logo == Logo("Mark_1.png", b"\x89PNG")
