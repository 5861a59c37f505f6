//! Requests on the command line, and the printed lines.
//!
//! The tests of this module do not use a measurement, so that they need no solver to be compiled.

use serde_json::Value;

/// Subject of the measurement.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Job {
    /// The list of formulations.
    Formulations,
    /// The cost of a fork of a team.
    Forks,
    /// A run of index-3 as published or in our form, with 16 or 32 digits.
    Digits(Vec<String>),
    /// Operations, bytes and the rates of the machine.
    Profile(Vec<String>),
    /// The steps of a scene in formulations, whose names are separated by commas.
    Scene { scene: String, formulations: String },
}

/// Options of a job's measurements.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Request {
    /// Sizes of thread teams; size one is always measured.
    pub(crate) threads: Vec<usize>,
    /// Approximate time of each interleaved measurement [s].
    pub(crate) seconds: f64,
}

/// The job that the words name, and its options.
pub(crate) fn parse(words: &[String]) -> Result<(Job, Request), String> {
    let mut request = Request { threads: vec![1], seconds: 1.0 };
    let (mut places, mut words) = (Vec::new(), words.iter());
    while let Some(word) = words.next() {
        let mut value = || words.next().ok_or_else(|| format!("{word} needs a value"));
        match word.as_str() {
            "--threads" => {
                let numbers = value()?.split(',').map(str::parse);
                let numbers: Result<Vec<usize>, _> = numbers.collect();
                request.threads = numbers.map_err(|e| format!("--threads: {e}"))?;
            }
            "--seconds" => {
                request.seconds = value()?.parse().map_err(|e| format!("--seconds: {e}"))?;
            }
            _ => places.push(word.clone()),
        }
    }
    request.threads.retain(|&n| n > 0);
    Ok((job(&places)?, request))
}

fn job(places: &[String]) -> Result<Job, String> {
    match places {
        [word] if word == "formulations" => Ok(Job::Formulations),
        [word] if word == "forks" => Ok(Job::Forks),
        [word, words @ ..] if word == "digits" => Ok(Job::Digits(words.to_vec())),
        [word, words @ ..] if word == "profile" => Ok(Job::Profile(words.to_vec())),
        [scene, formulations] => {
            Ok(Job::Scene { scene: scene.clone(), formulations: formulations.clone() })
        }
        _ => Err(
            "expected `formulations`, `forks`, `digits`, `profile`, or a scene and formulations"
                .to_owned(),
        ),
    }
}

/// Prints one line of output.
#[allow(clippy::print_stdout, reason = "the lines are what is asked for")]
pub(crate) fn say(line: &Value) {
    println!("{line}");
}

/// Adds keys to a line. An existing key keeps its value.
pub(crate) fn merge<const N: usize>(line: &mut Value, more: [Value; N]) {
    for more in more {
        let (Value::Object(line), Value::Object(more)) = (&mut *line, more) else { continue };
        for (key, value) in more {
            line.entry(key).or_insert(value);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn lines_are_merged_without_loss() {
        let mut line = json!({ "a": 1 });
        merge(&mut line, [json!({ "a": 2, "b": 3 }), json!(4)]);
        assert_eq!(line, json!({ "a": 1, "b": 3 }));
    }

    #[test]
    fn arguments_are_a_job_and_options() {
        let asked = |text: &str| parse(&text.split(' ').map(str::to_owned).collect::<Vec<_>>());
        let (job, request) = asked("andrews index-3 --threads 1,2 --seconds 0.5").unwrap();
        let scene = Job::Scene { scene: "andrews".to_owned(), formulations: "index-3".to_owned() };
        assert_eq!(job, scene);
        assert_eq!(request, Request { threads: vec![1, 2], seconds: 0.5 });
        assert_eq!(asked("profile rates").unwrap().0, Job::Profile(vec!["rates".to_owned()]));
        assert!(asked("forks --threads").is_err());
        assert!(asked("forks --threads x").is_err());
        assert!(asked("forks a b").is_err());
    }
}
