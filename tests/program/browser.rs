//! A browser without a window, driven by WebDriver's JSON (W3C) over HTTP.
#![allow(dead_code)]

use std::{
    io::{BufRead, BufReader},
    path::Path,
    process::{Child, Command, Stdio},
    time::Duration,
};

use serde_json::{Value, json};
use tempfile::TempDir;
use ureq::Agent;

const CHROMIUM: &str = "/usr/bin/chromium";
const DRIVER: &str = "/usr/bin/chromedriver";

/// A browser with a session; both end with it.
pub struct Browser {
    driver: Child,
    agent: Agent,
    session: String,
    profile: TempDir,
}

impl Browser {
    /// Starts one; `None`, with a word on standard error, where none is installed.
    pub fn start() -> Option<Self> {
        if !Path::new(CHROMIUM).exists() || !Path::new(DRIVER).exists() {
            eprintln!("skipped: {CHROMIUM} and {DRIVER} are not installed");
            return None;
        }
        let profile = TempDir::new().unwrap();
        let mut driver = Command::new(DRIVER)
            .arg("--port=0")
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut lines = BufReader::new(driver.stdout.take().unwrap()).lines();
        let port = lines
            .by_ref()
            .map_while(Result::ok)
            .find_map(|line| {
                line.split("successfully on port ")
                    .nth(1)
                    .map(|p| p.trim_end_matches('.').to_owned())
            })
            .expect("chromedriver says its port");
        // What it says later must not fill the pipe.
        std::thread::spawn(move || lines.for_each(drop));
        let agent: Agent = Agent::config_builder()
            .http_status_as_error(false)
            .timeout_global(Some(Duration::from_secs(60)))
            .build()
            .into();
        let mut browser = Self {
            driver,
            agent,
            session: format!("http://127.0.0.1:{port}/session"),
            profile,
        };
        let arguments = [
            "--headless".into(),
            "--no-sandbox".into(),
            "--disable-gpu".into(),
            "--disable-quic".into(),
            "--no-first-run".into(),
            "--disable-background-networking".into(),
            "--disable-component-update".into(),
            "--disable-sync".into(),
            format!("--user-data-dir={}", browser.profile.path().display()),
        ];
        let options = json!({ "binary": CHROMIUM, "args": arguments });
        let wanted = json!({ "capabilities": { "alwaysMatch": {
            "browserName": "chrome",
            "goog:chromeOptions": options,
            "goog:loggingPrefs": { "browser": "ALL", "performance": "ALL" },
        }}});
        let made = browser.post("", &wanted);
        let id = made["sessionId"].as_str().expect("a session");
        browser.session = format!("{}/{id}", browser.session);
        Some(browser)
    }

    fn post(&self, path: &str, body: &Value) -> Value {
        let url = format!("{}{path}", self.session);
        let mut answer = self
            .agent
            .post(&url)
            .header("Content-Type", "application/json")
            .send(body.to_string())
            .unwrap_or_else(|error| panic!("{url}: {error}"));
        let text = answer.body_mut().read_to_string().unwrap();
        let mut value: Value = serde_json::from_str(&text).unwrap();
        let value = value["value"].take();
        assert!(value.get("error").is_none(), "{path} {body}: {value}");
        value
    }

    /// Opens a file.
    pub fn open(&self, file: &Path) {
        self.post(
            "/url",
            &json!({ "url": format!("file://{}", file.display()) }),
        );
    }

    /// Runs the body of a function in the page.
    pub fn run(&self, script: &str) -> Value {
        self.post("/execute/sync", &json!({ "script": script, "args": [] }))
    }

    /// Waits until a condition in the page holds; whether it does within five seconds. What the
    /// compositor does, such as scrolling, reaches the page when it is next drawn.
    pub fn until(&self, condition: &str) -> bool {
        (0..100).any(|_| {
            let holds = self.run(&format!("return Boolean({condition});")) == true;
            if !holds {
                std::thread::sleep(std::time::Duration::from_millis(50));
            }
            holds
        })
    }

    /// A command of the developer tools.
    pub fn tell(&self, command: &str, parameters: &Value) {
        let body = json!({ "cmd": command, "params": parameters });
        self.post("/goog/cdp/execute", &body);
    }

    /// A window of that width, and light or dark.
    pub fn look(&self, width: u32, scheme: &str) {
        let metrics =
            json!({ "width": width, "height": 800, "deviceScaleFactor": 1, "mobile": false });
        self.tell("Emulation.setDeviceMetricsOverride", &metrics);
        let feature = json!({ "name": "prefers-color-scheme", "value": scheme });
        self.tell(
            "Emulation.setEmulatedMedia",
            &json!({ "features": [feature] }),
        );
    }

    /// Entries of a log since it was read last.
    pub fn log(&self, kind: &str) -> Vec<Value> {
        let entries = self.post("/se/log", &json!({ "type": kind }));
        entries.as_array().cloned().unwrap_or_default()
    }

    fn act(&self, actions: &Value) {
        self.post("/actions", &json!({ "actions": actions }));
    }

    /// Moves the pointer to a place in the window.
    pub fn point(&self, [x, y]: [f64; 2]) {
        self.act(&json!([pointer(&[to([x, y])])]));
    }

    /// Clicks at a place in the window.
    pub fn click(&self, at: [f64; 2]) {
        let [down, up] = ["pointerDown", "pointerUp"].map(|t| json!({ "type": t, "button": 0 }));
        self.act(&json!([pointer(&[to(at), down, up])]));
    }

    /// Drags from a place to another.
    pub fn drag(&self, from: [f64; 2], end: [f64; 2]) {
        let [down, up] = ["pointerDown", "pointerUp"].map(|t| json!({ "type": t, "button": 0 }));
        self.act(&json!([pointer(&[to(from), down, to(end), up])]));
    }

    /// Turns the wheel at a place.
    pub fn wheel(&self, [x, y]: [f64; 2], by: i32) {
        let turn = json!({
            "type": "scroll", "x": whole(x), "y": whole(y), "deltaX": 0, "deltaY": by,
            "origin": "viewport", "duration": 0
        });
        self.act(&json!([{ "type": "wheel", "id": "wheel", "actions": [turn] }]));
    }

    /// Presses keys one after the other.
    pub fn keys(&self, keys: &str) {
        let actions: Vec<Value> = keys
            .chars()
            .flat_map(|key| {
                ["keyDown", "keyUp"].map(|t| json!({ "type": t, "value": key.to_string() }))
            })
            .collect();
        self.act(&json!([{ "type": "key", "id": "keys", "actions": actions }]));
    }
}

#[expect(clippy::cast_possible_truncation, reason = "a place in a window")]
fn whole(x: f64) -> i64 {
    x.round() as i64
}

fn pointer(actions: &[Value]) -> Value {
    json!({
        "type": "pointer", "id": "mouse", "parameters": { "pointerType": "mouse" },
        "actions": actions,
    })
}

fn to([x, y]: [f64; 2]) -> Value {
    json!({ "type": "pointerMove", "x": x.round(), "y": y.round(), "duration": 0, "origin": "viewport" })
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = self.agent.delete(&self.session).call();
        let _ = self.driver.kill();
        let _ = self.driver.wait();
    }
}
