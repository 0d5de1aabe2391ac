//! Every file of `problems/hybrid`: without warnings, listed, and run as its comment says.

use std::path::Path;

use super::{Failure, Scheme, model, run};

/// The initial state and the end time of the line `` `--initial x=1,v=0 --end 7` ``.
fn request(text: &str, states: &[&str]) -> Result<(Vec<f64>, f64), Failure> {
    let (_, rest) = text.split_once("`--initial ").ok_or("no request")?;
    let (line, _) = rest.split_once('`').ok_or("an open request")?;
    let (initial, end) = line.split_once(" --end ").ok_or("no end time")?;
    // what the program starts at zero
    let mut x0 = vec![0.0; states.len()];
    for assignment in initial.split(',') {
        let (name, value) = assignment.split_once('=').ok_or("no value")?;
        let index = states.iter().position(|state| *state == name);
        x0[index.ok_or("an unknown state")?] = value.parse()?;
    }
    Ok((x0, end.parse()?))
}

#[test]
fn every_file_runs_as_its_comment_says() -> Result<(), Failure> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../problems/hybrid");
    let list = std::fs::read_to_string(folder.join("README.md"))?;
    let mut files = 0;
    for entry in folder.read_dir()? {
        let path = entry?.path();
        if path.extension().is_none_or(|extension| extension != "pws") {
            continue;
        }
        let name = path.file_name().unwrap_or_default().display().to_string();
        assert!(
            list.contains(&format!("| `{name}` |")),
            "{name} is not listed"
        );
        let text = std::fs::read_to_string(&path)?;
        let system = model(&text, &[])?;
        assert_eq!(system.warnings().next(), None, "{name}");
        let (x0, t_end) = request(&text, system.metadata().states)?;
        let way = run(&system, Scheme::Best, &x0, t_end)?;
        assert!(
            way.t == t_end && !way.passages.is_empty(),
            "{name}: {way:?}"
        );
        files += 1;
    }
    assert_eq!(files, 19);
    Ok(())
}
