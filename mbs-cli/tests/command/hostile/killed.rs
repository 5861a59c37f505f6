//! Processes that are killed at random times: the directory has either the old or the new results, and a resumed run gives the same bits.

use super::{Place, ended, results, wait_for};
use crate::text;
use mbs::folder::{Folder, PART};
use mbs::scene_file::Dice;
use std::process::Stdio;
use std::time::Duration;

/// Number of kills, and how many of them are late, while the files are put into place.
const KILLS: usize = 20;
const LATE: usize = 8;
/// Options of a run of a tenth of a second or more of CPU time, with a checkpoint at each tenth of it.
const LONG: &str = "--step 1e-4 --duration 10 --checkpoint 1";

#[test]
fn a_run_killed_at_any_time_leaves_the_old_or_the_new_and_resumes_to_the_same_bits() {
    let place = Place::new("killed");
    let made = |arguments: &str| {
        let made = ended(&mut place.run(arguments));
        assert_eq!(made.status.code(), Some(0), "{arguments}: {}", text(&made.stderr));
    };
    made("--out old");
    made(&format!("--out whole {LONG}"));
    let (old, whole) = (results(&place.0.join("old")), results(&place.0.join("whole")));
    let tables = |results: &[(String, Vec<u8>)]| -> Vec<Vec<u8>> {
        results.iter().take(2).map(|(_, bytes)| bytes.clone()).collect()
    };
    let mut dice = Dice::new(1);
    for k in 0..KILLS {
        let name = format!("out-{k}");
        let out = place.0.join(&name);
        std::fs::create_dir(&out).expect("it is ours");
        for (file, bytes) in &old {
            std::fs::write(out.join(file), bytes).expect("it is ours");
        }
        let mut command = place.run(&format!("--out {name} {LONG}"));
        let command = command.stdout(Stdio::null()).stderr(Stdio::null());
        let mut child = command.spawn().expect("the command is built");
        if k >= KILLS - LATE {
            let page = out.join(PART).join("run.html");
            let mut is_over = || child.try_wait().expect("our child").is_some();
            wait_for("the page", || page.exists() || is_over());
            std::thread::sleep(Duration::from_micros(200 * dice.below(50) as u64));
        } else {
            std::thread::sleep(Duration::from_millis(dice.below(200) as u64));
        }
        let _ = child.kill();
        child.wait().expect("our child");

        let now = results(&out);
        let is_mixed = Folder::mixed(&out).is_some();
        let is_whole = tables(&now) == tables(&old) || tables(&now) == tables(&whole);
        assert!(is_mixed || (now.len() == 4 && is_whole), "kill {k}: {:?}", place.names(&name));
        // there is no checkpoint if the run had not begun, or if it had ended
        let is_kept = out.join(mbs::CHECKPOINT).exists();
        let again =
            if is_kept { format!("--out {name} --resume") } else { format!("--out {name} {LONG}") };
        made(&again);
        assert!(tables(&results(&out)) == tables(&whole), "kill {k}: {again}");
        assert_eq!(
            place.names(&name),
            ["run.csv", "run.html", "run.json", "steps.csv"],
            "kill {k}"
        );
        assert_eq!(Folder::mixed(&out), None, "kill {k}");
    }
}
