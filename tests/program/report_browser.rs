//! The report page in a real browser: it opens without complaint, fits, and answers. Needs
//! Chromium with its driver; where they are not installed the tests say so and pass.

use super::{browser::Browser, reports};
use serde_json::Value;
use tempfile::TempDir;

/// Keys of WebDriver.
const LEFT: char = '\u{e012}';
const UP: char = '\u{e013}';
const RIGHT: char = '\u{e014}';
const DOWN: char = '\u{e015}';

/// A browser with the page open, 1280 pixels wide.
fn opened() -> Option<(Browser, TempDir)> {
    let browser = Browser::start()?;
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("report.html");
    std::fs::write(&file, reports::shared()).unwrap();
    browser.look(1280, "light");
    browser.open(&file);
    Some((browser, folder))
}

/// The middle of an element in the window, scrolled into it.
fn place(browser: &Browser, selector: &str) -> [f64; 2] {
    let script = format!(
        "const e = document.querySelector({selector:?}); e.scrollIntoView({{block: 'center'}}); \
         const b = e.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2];"
    );
    let value = browser.run(&script);
    [0, 1].map(|k| value[k].as_f64().unwrap())
}

fn text(browser: &Browser, selector: &str) -> String {
    let script = format!("return document.querySelector({selector:?}).textContent;");
    browser.run(&script).as_str().unwrap().to_owned()
}

fn has(browser: &Browser, selector: &str) -> bool {
    browser.run(&format!(
        "return document.querySelector({selector:?}) !== null;"
    )) == true
}

#[test]
fn opens_without_complaint_or_network() {
    let Some((browser, _folder)) = opened() else {
        return;
    };
    let complaints = browser.log("browser");
    assert!(complaints.is_empty(), "{complaints:?}");
    for entry in browser.log("performance") {
        let message: Value = serde_json::from_str(entry["message"].as_str().unwrap()).unwrap();
        let message = &message["message"];
        if message["method"] == "Network.requestWillBeSent" {
            let request = &message["params"];
            // The browser's own first page is not ours.
            let ours = request["documentURL"].as_str().unwrap();
            if !ours.ends_with("/report.html") {
                continue;
            }
            let url = request["request"]["url"].as_str().unwrap();
            assert!(
                url.starts_with("file:///") && url.ends_with("/report.html"),
                "{url}"
            );
        }
    }
    // Hostile names are text: no picture, no alert.
    assert_eq!(browser.run("return document.images.length;"), 0);
    assert!(text(&browser, "h1").contains("<img src=x"));
}

/// At either width and in either scheme nothing sticks out but in boxes that scroll, and text stands
/// out from its ground by WCAG's 4.5.
#[test]
fn fits_and_can_be_read() {
    let Some((browser, _folder)) = opened() else {
        return;
    };
    for width in [360, 1280] {
        for scheme in ["light", "dark"] {
            browser.look(width, scheme);
            let wide = browser.run(
                "const page = document.documentElement; const out = [];
                 if (page.scrollWidth > innerWidth) out.push(`page ${page.scrollWidth}`);
                 for (const e of document.body.querySelectorAll('*:not(.skip)')) {
                   if (e.closest('svg') || e.parentElement.closest('.table, .plot-scroll, pre')) continue;
                   const b = e.getBoundingClientRect();
                   if (b.width && (b.right > innerWidth + 0.5 || b.left < -0.5)) out.push(e.outerHTML.slice(0, 120));
                 }
                 return out;",
            );
            assert_eq!(wide, serde_json::json!([]), "{width} {scheme}");
            let faint = browser.run(CONTRAST);
            assert_eq!(faint, serde_json::json!([]), "{width} {scheme}");
            let ground = browser.run("return getComputedStyle(document.body).backgroundColor;");
            assert_eq!(
                ground == "rgb(255, 255, 255)",
                scheme == "light",
                "{ground}"
            );
        }
    }
}

/// Texts whose contrast to the ground behind them is below 4.5 (WCAG 2.1, 1.4.3).
const CONTRAST: &str = r"
const parts = (c) => c.match(/[\d.]+/g).map(Number);
const light = ([r, g, b]) => [r, g, b].map((v) => v / 255)
  .map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4))
  .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
const ground = (e) => {
  for (; e; e = e.parentElement) {
    const c = parts(getComputedStyle(e).backgroundColor);
    if (c.length < 4 || c[3] > 0) return c;
  }
  return [255, 255, 255];
};
const faint = [];
for (const e of document.body.querySelectorAll('*')) {
  const own = [...e.childNodes].some((n) => n.nodeType === 3 && n.data.trim());
  if (!own || e.tagName === 'SCRIPT' || e.closest('svg') || !e.getClientRects().length) continue;
  const [a, b] = [light(parts(getComputedStyle(e).color)), light(ground(e))].sort((x, y) => y - x);
  if ((a + 0.05) / (b + 0.05) < 4.5) faint.push(`${e.className} ${e.textContent.slice(0, 40)}`);
}
return faint;
";

#[test]
fn charts_answer_to_pointer_and_wheel() {
    let Some((browser, _folder)) = opened() else {
        return;
    };
    let chart = "[data-chart=speed-bending-stiffness]";
    let output = format!("{chart} output");
    let zoomed = format!("{chart} .panel.zoomed");
    let at = place(&browser, &format!("{chart} .mark"));
    browser.point(at);
    // K_b and V_cr of the design, in both units.
    let said = text(&browser, &output);
    assert!(
        said.starts_with("design: K_b ") || said.starts_with("design: Kb "),
        "{said}"
    );
    for unit in ["kN m/rad", "lbf ft/rad", "km/h", "mph"] {
        assert!(said.contains(unit), "{said}");
    }
    assert!(has(
        &browser,
        &format!("{chart} .crosshair.shown circle.on")
    ));
    // The wheel scrolls the page until the chart has the focus.
    let before = browser.run("return scrollY;").as_f64().unwrap();
    browser.wheel(at, 120);
    assert!(!has(&browser, &zoomed));
    assert!(browser.until(&format!("scrollY > {before}")));
    let at = place(&browser, &format!("{chart} .mark"));
    browser.run(&format!(
        "document.querySelector('{chart} .plot').focus({{preventScroll: true}});"
    ));
    let before = browser.run("return scrollY;");
    browser.wheel(at, -400);
    assert!(browser.until(&format!("document.querySelector('{zoomed}')")));
    assert_eq!(browser.run("return scrollY;"), before);
    // What the pointer is at stays there, and its value with it.
    let still = place(&browser, &format!("{chart} .mark"));
    assert!((still[0] - at[0]).abs() < 2.0 && (still[1] - at[1]).abs() < 2.0);
    browser.point(still);
    assert_eq!(text(&browser, &output), said);
    assert!(has(&browser, &format!("{chart} .axis.view .tick-label")));
    // Dragging takes the chart along.
    browser.drag(
        [still[0] + 30.0, still[1] + 20.0],
        [still[0] + 70.0, still[1] + 40.0],
    );
    let moved = place(&browser, &format!("{chart} .mark"));
    assert!(
        (moved[0] - still[0] - 40.0).abs() < 2.0,
        "{moved:?} {still:?}"
    );
    let whole = place(&browser, &format!("{chart} [data-action=whole]"));
    browser.click(whole);
    assert!(!has(&browser, &zoomed));
    let closer = place(&browser, &format!("{chart} [data-action=in]"));
    browser.click(closer);
    assert!(has(&browser, &zoomed));
    assert!(browser.log("browser").is_empty());
}

#[test]
fn charts_answer_to_the_keyboard() {
    let Some((browser, _folder)) = opened() else {
        return;
    };
    let chart = "[data-chart=root-locus]";
    let output = format!("{chart} output");
    browser.run(&format!("document.querySelector('{chart} .plot').focus();"));
    browser.keys(&RIGHT.to_string());
    let first = text(&browser, &output);
    assert!(first.contains("km/h") && first.contains("mph"), "{first}");
    browser.keys(&format!("{DOWN}{RIGHT}{RIGHT}"));
    let second = text(&browser, &output);
    assert!(!second.is_empty() && second != first, "{second}");
    browser.keys("++");
    assert!(has(&browser, &format!("{chart} .panel.zoomed")));
    browser.keys("0");
    assert!(!has(&browser, &format!("{chart} .panel.zoomed")));
    // The next panel says its title; there too there is something to read.
    browser.keys("\u{e00f}");
    browser.keys(&format!("{RIGHT}{LEFT}{UP}"));
    assert_ne!(text(&browser, &output), second);
    assert!(browser.log("browser").is_empty());
}

#[test]
fn the_front_shows_the_design_behind_a_point() {
    let Some((browser, _folder)) = opened() else {
        return;
    };
    let shown = || {
        let script = "return [...document.querySelectorAll('[data-design]')] \
                      .map((e, i) => e.hidden ? -1 : i).filter((i) => i >= 0);";
        browser.run(script)
    };
    assert_eq!(shown(), serde_json::json!([0]));
    browser.click(place(&browser, "[data-point='1']"));
    assert_eq!(shown(), serde_json::json!([1]));
    assert!(has(&browser, "[data-point='1'][aria-pressed=true]"));
    browser.keys(&DOWN.to_string());
    assert_eq!(shown(), serde_json::json!([2]));
    browser.click(place(&browser, "[data-chart=front] .mark"));
    assert_eq!(shown(), serde_json::json!([0]));
    browser.run("document.querySelector('[data-chart=front] .plot').focus();");
    browser.keys(&format!("{RIGHT}{RIGHT}"));
    assert_eq!(shown(), serde_json::json!([1]));
    assert!(has(&browser, "[data-chart=front] .mark.picked"));
    assert!(browser.log("browser").is_empty());
}
