//! `mbs run --open` and `--watch`, completions, manual pages, and mistyped commands.

use super::{mbs, plain, run, status, text};
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::{Duration, Instant, SystemTime};

/// A new folder with a pendulum in it.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("the directory is ours");
    let scene = plain(folder.join("pendulum.toml"));
    assert_eq!(status(&run("new", &["pendulum", &scene])), 0);
    folder
}

#[test]
fn without_a_screen_open_prints_the_path_of_the_page_and_writes_to_out() {
    let folder = folder("open");
    let mut command = mbs("run");
    command.args(["pendulum.toml", "--open", "--no-estimate"]).current_dir(&folder);
    let output = command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").output();
    let output = output.expect("the command is built");
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    let page = folder.canonicalize().expect("it is there").join("out/run.html");
    assert!(page.is_file());
    let said = text(&output.stderr);
    // on other systems the page is open now, and its path is not printed
    if cfg!(all(unix, not(target_os = "macos"))) {
        assert!(said.contains(&plain(page)), "{said}");
    }
}

/// Waits until a condition holds.
fn until(what: &str, mut holds: impl FnMut() -> bool) {
    let begin = Instant::now();
    while !holds() {
        assert!(begin.elapsed() < Duration::from_secs(60), "{what} within a minute");
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn watch_runs_again_after_a_change_and_keeps_the_last_good_page() {
    let folder = folder("watch");
    let (scene, page) = (folder.join("pendulum.toml"), folder.join("out/run.html"));
    let log = std::fs::File::create(folder.join("log")).expect("the directory is ours");
    let mut command = mbs("run");
    command.args(["pendulum.toml", "--watch", "--no-estimate", "--duration", "0.1"]);
    command.current_dir(&folder).stdout(Stdio::null()).stderr(log);
    let mut watching = command.spawn().expect("the command is built");
    let said = || std::fs::read_to_string(folder.join("log")).unwrap_or_default();
    let change = || -> Option<SystemTime> { page.metadata().ok()?.modified().ok() };
    until("a first page", || said().matches("watching").count() == 1 && page.is_file());
    let (first, good) = (change(), std::fs::read_to_string(&scene).expect("it is there"));
    std::fs::write(&scene, good.replace("mass", "mas")).expect("it is ours");
    until("a refusal", || said().contains("mas") && said().matches("watching").count() == 2);
    assert_eq!(change(), first, "the page of the last good run stays");
    std::fs::write(&scene, good + "# again\n").expect("it is ours");
    until("a second page", || change() != first);
    watching.kill().expect("it is ours");
    let _ = watching.wait();
}

#[test]
fn completions_name_every_command_and_manual_pages_are_written() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let output = run("completions", &[shell]);
        let script = text(&output.stdout);
        assert_eq!(status(&output), 0);
        assert!(
            ["equilibrium", "sweep", "man"].iter().all(|name| script.contains(name)),
            "{shell}"
        );
    }
    let dir = Path::new(env!("CARGO_TARGET_TMPDIR")).join("man");
    assert_eq!(status(&run("man", &[&plain(dir.clone())])), 0);
    for (page, part) in [("mbs.1", "multibody"), ("mbs-run.1", "formulation")] {
        let page = std::fs::read_to_string(dir.join(page)).expect("it is written");
        assert!(page.contains(".TH") && page.contains(part), "{page}");
    }
}

#[test]
fn a_mistyped_command_is_met_with_the_nearest_and_another_programs_word_with_ours() {
    for (word, remedy) in [("rnu", "run"), ("equlibrium", "equilibrium"), ("simulate", "mbs run")] {
        let output = run(word, &[]);
        assert_eq!(status(&output), 1);
        assert!(text(&output.stderr).contains(remedy), "{word}: {}", text(&output.stderr));
    }
}

#[test]
fn the_help_lists_every_command_once_in_a_group() {
    let help = text(&run("--help", &[]).stdout);
    for name in super::help::COMMANDS {
        let lines = help.lines().filter(|line| line.starts_with(&format!("  {name:<12} ")));
        assert_eq!(lines.count(), 1, "{name}: {help}");
    }
}
