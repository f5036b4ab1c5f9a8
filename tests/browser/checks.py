"""What every participant page must hold in every state: axe, structure, no sideways scroll, nothing cut, no motion."""

from __future__ import annotations

from axe_playwright_python.sync_playwright import Axe

RULES = {
    "runOnly": {"type": "tag", "values": ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]},
    # Text over a picture cannot be judged by a program.
    "resultTypes": ["violations"],
}
DESKTOP = (1280, 800)
NARROW = ((360, 740), (320, 568))
ZOOMED = (640, 400)
WIDE = ((1366, 625), (1024, 768), (800, 600))

# WCAG 1.4.12; an author's own style sheet would be refused by the pages' policy, so the context bypasses it.
SPACING = "* { line-height: 1.5 !important; letter-spacing: .12em !important; word-spacing: .16em !important }"
SPACING += " p { margin-block-end: 2em !important }"

SHOWN = """
  const shown = (node) => node.checkVisibility({ checkOpacity: true, checkVisibilityCSS: true })
    && !node.closest(".visually-hidden, .skip, .sprite");
  const told = (node) => `${node.tagName}.${node.className} ${node.textContent.trim().slice(0, 40)}`;
"""
SIDEWAYS = "() => document.documentElement.scrollWidth - innerWidth"
# Text that a box of fixed size hides, and what stands outside of the window.
CUT = f"""() => {{ {SHOWN}
  const texts = ":is(h1, h2, p, b, span, a, button, label, legend, dt, dd, li, kbd)";
  const nodes = [...document.querySelectorAll(`body ${{texts}}`)];
  const hides = (node) => getComputedStyle(node).overflowX !== "visible" && node.scrollWidth > node.clientWidth + 1;
  const outside = (node) => {{
    const box = node.getBoundingClientRect();
    return box.width && (box.left < -1 || box.right > innerWidth + 1);
  }};
  const tight = (node) => node.matches(".button, .strip, .mini-strip, kbd, .point label")
    && (node.scrollHeight > node.clientHeight + 2 || node.scrollWidth > node.clientWidth + 2);
  return nodes.filter((node) => shown(node) && node.textContent.trim() && (hides(node) || outside(node) || tight(node)))
    .map(told);
}}"""
# On the wide evolve page nothing scrolls: question, ten tiles and footer have to fit, one below the other.
STACKED = """() => {
  const box = (selector) => document.querySelector(selector).getBoundingClientRect();
  const [question, grid, footer] = [".question", "#grid", ".footer"].map(box);
  return { question: grid.top - question.bottom, grid: footer.top - grid.bottom, footer: innerHeight - footer.bottom };
}"""
MOVING = f"""() => {{ {SHOWN}
  const seconds = (text) => Math.max(...text.split(",").map(parseFloat));
  const moves = ({{ transitionDuration, animationName, animationDuration }}) =>
    seconds(transitionDuration) > 0 || (animationName !== "none" && seconds(animationDuration) > 0);
  return [...document.querySelectorAll("body *")].filter((node) => moves(getComputedStyle(node))).map(told);
}}"""
FROM = """(start) => {
  const node = document.querySelector(start);
  node.tabIndex = -1;
  node.focus();
  node.removeAttribute("tabindex");
}"""
RINGED = """() => {
  const node = document.activeElement;
  const near = [node, ...(node.parentElement?.children ?? [])];
  const ringed = ({ outlineStyle, outlineWidth }) => outlineStyle !== "none" && parseFloat(outlineWidth) >= 2;
  return { body: node === document.body, name: `${node.tagName}#${node.id}.${node.className}`,
    ringed: near.some((one) => ringed(getComputedStyle(one))) };
}"""


def accessible(page):
    """Hold axe's rules, once the page has its styles: without them everything has another size."""
    page.wait_for_load_state()
    found = Axe().run(page, options=RULES).response["violations"]
    assert [(rule["id"], [node["html"][:200] for node in rule["nodes"]]) for rule in found] == []


def built(page, language="en", direction="ltr"):
    """One heading, a title, landmarks, and the language said."""
    root = page.evaluate("[document.documentElement.lang, document.documentElement.dir]")
    assert root == [language, direction]
    assert page.locator("h1").count() == 1
    assert page.locator("main").count() == 1
    assert page.title().strip()
    assert page.locator(".skip").get_attribute("href") == "#main"


def fits(page, size):
    """Nothing scrolls sideways, nothing is cut at a size of the window."""
    resized(page, size)
    assert (size, max(page.evaluate(SIDEWAYS), 0), page.evaluate(CUT)) == (size, 0, [])


def stacks(page, size):
    """The wide evolve page shows everything without scrolling."""
    resized(page, size)
    gaps = page.evaluate(STACKED)
    assert min(gaps.values()) >= 0, (size, gaps)


def holds_spacing(page, size):
    """More space between letters, words and lines loses nothing."""
    resized(page, size)
    style = page.add_style_tag(content=SPACING)
    try:
        assert (size, max(page.evaluate(SIDEWAYS), 0), page.evaluate(CUT)) == (size, 0, [])
    finally:
        style.evaluate("node => node.remove()")


def still(page):
    """Nothing moves for those who asked for less motion."""
    assert page.evaluate(MOVING) == []


def focus_is_seen(page, stops=60):
    """Every stop of the Tab key has a ring, on itself or on what is drawn for it; the first stop is the skip link."""
    start = "dialog[open]" if page.locator("dialog[open]").count() else "body"
    # What was focused before is where Tab would go on from.
    page.evaluate(FROM, start)
    page.keyboard.press("Tab")
    assert start != "body" or page.evaluate("document.activeElement.matches('.skip')")
    for _ in range(stops):
        told = page.evaluate(RINGED)
        if told["body"]:
            break
        assert told["ringed"], told["name"]
        page.keyboard.press("Tab")


def resized(page, size):
    """Make the window that large and let the page settle."""
    page.set_viewport_size({"width": size[0], "height": size[1]})
    page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
