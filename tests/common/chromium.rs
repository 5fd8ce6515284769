//! A real Chromium without a window, spoken to through its DevTools protocol: JSON texts that end in
//! a zero byte, over a pair of pipes.
#![allow(dead_code, reason = "each test file uses its own part")]

use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};
use tempfile::TempDir;

/// Names that it goes by; `CHROMIUM` in the environment names another.
const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];

/// A browser with one page.
pub struct Chromium {
    child: Child,
    to: File,
    from: BufReader<File>,
    session: String,
    calls: u64,
    /// What the page told without being asked.
    events: Vec<Value>,
    _files: TempDir,
}

impl Chromium {
    /// Starts one; `None`, with a word on it, where there is none.
    pub fn start() -> Option<Chromium> {
        let Some(program) = program() else {
            eprintln!("skipped: no Chromium here; CHROMIUM may name one");
            return None;
        };
        let files = tempfile::tempdir().unwrap();
        let pipes = ["in", "out"].map(|name| files.path().join(name));
        assert!(Command::new("mkfifo").args(&pipes).status().unwrap().success());
        let child = Command::new("sh")
            .args(["-c", "in=$1 out=$2; shift 2; exec \"$@\" 3<\"$in\" 4>\"$out\"", "sh"])
            .args(&pipes)
            .arg(program)
            .args([
                "--headless",
                "--no-sandbox",
                "--disable-gpu",
                "--disable-quic",
                "--no-first-run",
                "--disable-background-networking",
                "--disable-component-update",
                "--disable-sync",
                "--hide-scrollbars",
                "--remote-debugging-pipe",
            ])
            .arg(format!("--user-data-dir={}", files.path().join("profile").display()))
            .arg("about:blank")
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let to = OpenOptions::new().write(true).open(&pipes[0]).unwrap();
        let from = BufReader::new(File::open(&pipes[1]).unwrap());
        let (session, events) = (String::new(), Vec::new());
        let mut browser = Chromium { child, to, from, session, calls: 0, events, _files: files };
        browser.attach();
        Some(browser)
    }

    fn attach(&mut self) {
        let page = self.call("Target.createTarget", json!({ "url": "about:blank" }));
        let target = json!({ "targetId": page["targetId"], "flatten": true });
        let session = self.call("Target.attachToTarget", target);
        self.session = session["sessionId"].as_str().unwrap().to_owned();
        for domain in ["Page", "Runtime", "Log", "Network"] {
            self.call(&format!("{domain}.enable"), json!({}));
        }
    }

    /// Calls a method of the protocol.
    pub fn call(&mut self, method: &str, params: Value) -> Value {
        self.calls += 1;
        let mut call = json!({ "id": self.calls, "method": method, "params": params });
        if !self.session.is_empty() {
            call["sessionId"] = json!(self.session);
        }
        self.to.write_all(format!("{call}\0").as_bytes()).unwrap();
        loop {
            let mut told = self.read();
            if told["id"] == json!(self.calls) {
                assert!(told["error"].is_null(), "{method}: {}", told["error"]);
                return told["result"].take();
            }
            self.events.push(told);
        }
    }

    fn read(&mut self) -> Value {
        let mut text = Vec::new();
        self.from.read_until(0, &mut text).unwrap();
        assert_eq!(text.pop(), Some(0), "Chromium ended");
        serde_json::from_slice(&text).unwrap()
    }

    /// Opens a file, and waits until it is loaded; returns how long that took, ms.
    pub fn open(&mut self, file: &Path, hash: &str) -> f64 {
        self.events.clear();
        // The same file with another hash would not load again.
        self.call("Page.navigate", json!({ "url": "about:blank" }));
        self.wait("Page.loadEventFired");
        self.events.clear();
        let url = format!("file://{}{hash}", file.display());
        self.call("Page.navigate", json!({ "url": url }));
        self.wait("Page.loadEventFired");
        self.settle();
        let read = "performance.timing.loadEventStart - performance.timing.navigationStart";
        self.run(read).as_f64().unwrap_or(f64::NAN)
    }

    fn wait(&mut self, event: &str) {
        while !self.events.iter().any(|told| told["method"] == event) {
            let told = self.read();
            self.events.push(told);
        }
    }

    /// Waits until the page has laid out all of itself, and has followed a choice everywhere.
    pub fn settle(&mut self) {
        self.run(
            "new Promise((done) => { const wait = () =>
            document.body.ariaBusy === 'true' || document.querySelector('html.opening')
                ? setTimeout(wait, 5) : done(); wait(); })",
        );
    }

    /// Runs a script in the page, and waits for its promise; returns its value.
    pub fn run(&mut self, script: &str) -> Value {
        let params = json!({
            "expression": script, "awaitPromise": true, "returnByValue": true, "userGesture": true,
        });
        let mut told = self.call("Runtime.evaluate", params);
        assert!(told["exceptionDetails"].is_null(), "{script}: {}", told["exceptionDetails"]);
        told["result"]["value"].take()
    }

    /// From now on counts the processor time of the page's thread; before the page is opened.
    pub fn count_processor_time(&mut self) {
        self.call("Performance.enable", json!({ "timeDomain": "threadTicks" }));
    }

    /// What the page's thread has computed so far, ms.
    pub fn processor_ms(&mut self) -> f64 {
        let told = self.call("Performance.getMetrics", json!({}));
        let metrics = told["metrics"].as_array().unwrap();
        let tasks = metrics.iter().find(|metric| metric["name"] == "TaskDuration").unwrap();
        1000.0 * tasks["value"].as_f64().unwrap()
    }

    /// Moves the pointer to the middle of the first element that a selector finds, brought into
    /// view, and clicks there if asked to.
    pub fn point_at(&mut self, selector: &str, click: bool) {
        let script = format!(
            "(() => {{ const e = document.querySelector({selector:?}); e.scrollIntoView({{block: 'center'}}); \
             const b = e.getBoundingClientRect(); return [b.left + b.width / 2, b.top + b.height / 2]; }})()"
        );
        let at = self.run(&script);
        let kinds = ["mouseMoved", "mousePressed", "mouseReleased"];
        for kind in &kinds[..if click { 3 } else { 1 }] {
            let button = if *kind == "mouseMoved" { "none" } else { "left" };
            let event =
                json!({ "type": kind, "x": at[0], "y": at[1], "button": button, "clickCount": 1 });
            self.call("Input.dispatchMouseEvent", event);
        }
        self.settle();
    }

    /// Presses a key.
    pub fn press(&mut self, key: &str) {
        let text = if key == "Enter" { "\r" } else { "" };
        for kind in ["keyDown", "keyUp"] {
            let code = if key == "Enter" { 13 } else { 0 };
            let mut event = json!({ "type": kind, "key": key, "windowsVirtualKeyCode": code });
            if kind == "keyDown" && !text.is_empty() {
                event["text"] = json!(text);
            }
            self.call("Input.dispatchKeyEvent", event);
        }
        self.settle();
    }

    /// A window of this size, CSS pixels.
    pub fn resize(&mut self, width: u32, height: u32) {
        let size =
            json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        self.call("Emulation.setDeviceMetricsOverride", size);
    }

    /// A picture of the window, or of the whole page.
    pub fn screenshot(&mut self, path: &Path, whole: bool) {
        let told = self.call("Page.captureScreenshot", json!({ "captureBeyondViewport": whole }));
        std::fs::write(path, base64(told["data"].as_str().unwrap())).unwrap();
    }

    /// The page as it prints.
    pub fn print(&mut self, path: &Path) {
        let told = self.call("Page.printToPDF", json!({ "printBackground": true }));
        std::fs::write(path, base64(told["data"].as_str().unwrap())).unwrap();
    }

    /// Errors of scripts and of the console, and whatever was asked of a network, since the page was
    /// opened.
    pub fn complaints(&mut self) -> Vec<String> {
        self.run("0"); // so that all has been told
        let is_far = |event: &Value| {
            let url = event["params"]["request"]["url"].as_str().unwrap_or_default();
            !["file:", "data:", "about:", "blob:"].iter().any(|near| url.starts_with(near))
        };
        let complains = |event: &&Value| match event["method"].as_str().unwrap_or_default() {
            "Runtime.exceptionThrown" | "Log.entryAdded" => true,
            "Runtime.consoleAPICalled" => event["params"]["type"] == "error",
            "Network.requestWillBeSent" => is_far(event),
            _ => false,
        };
        self.events.iter().filter(complains).map(|event| event["params"].to_string()).collect()
    }
}

impl Drop for Chromium {
    fn drop(&mut self) {
        let _ = self.to.write_all(b"{\"id\":0,\"method\":\"Browser.close\"}\0");
        let _ = self.child.wait();
    }
}

fn program() -> Option<String> {
    let there = |name: &String| {
        Command::new(name)
            .arg("--version")
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status()
            .is_ok()
    };
    let named = std::env::var("CHROMIUM").ok();
    named.into_iter().chain(NAMES.map(str::to_owned)).find(there)
}

fn base64(text: &str) -> Vec<u8> {
    STANDARD.decode(text).unwrap()
}
