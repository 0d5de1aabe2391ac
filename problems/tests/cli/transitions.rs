//! `pws run`: what it tells of transitions, of several kinds and between modes of several parts.

use std::fs;
use std::path::PathBuf;

use tempfile::TempDir;

use super::{Results, pws, texts};

/// A file with a declaration.
fn file(declaration: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("system.pws");
    fs::write(&path, declaration).unwrap();
    (folder, path)
}

/// What a run of a system says up to its time a step, and its files.
fn run(declaration: &str, options: &[&str]) -> (String, Results) {
    let (_folder, path) = file(declaration);
    let results = Results::within("out");
    let call = [&["run", path.to_str().unwrap()], options].concat();
    let text = results.said(&call);
    let end = text.find(" steps, ").expect("the time a step");
    let start = text[..end].rfind('\n').map_or(0, |place| place + 1);
    (text[..start].to_owned(), results)
}

/// A ball in a room with a step, which counts its bounces and loses speed at the lower floor.
const ROOM: &str = "system Room {
    state x, y, u, v;
    discrete bounces = 0;
    interface step = x - 1;
    interface wall = x - 3;
    interface low = y;
    interface high = y - 0.5;
    der(x) = u;
    der(y) = v;
    der(u) = 0;
    der(v) = -1;
    region upper where step < 0 {
        on high falling { v = -v; bounces = bounces + 1; }
    }
    region lower where step > 0 {
        on low falling { v = -v / 2; bounces = bounces + 1; }
    }
    on wall rising { u = -u; }
    at 4.25 { u = 2 * u; x = x + 0.125; y = y + 0.25; v = 0; }
}
";

#[test]
fn the_itinerary_tells_events_modes_and_jumps() {
    let (text, results) = run(ROOM, &["--initial", "y=1,u=0.75", "--end", "5"]);
    // `high` is passed in the lower region, where it has no event
    let expected = "\
Room: a system of your own
reached t = 5 by best with tolerance 1e-12
transitions: 5 (4 jumped, 1 crossed)

t           interface  g      kind     mode           state
1.00000000  high       falls  jumped   bounces 0 → 1  v -1 → 1
1.33333333  step       rises  crossed  upper → lower
3.41421356  low        falls  jumped   bounces 1 → 2  v -1.41421 → 0.707107
4.00000000  wall       rises  jumped                  u 0.75 → -0.75
4.25000000  at_2       rises  jumped                  x 2.8125 → 2.9375, y 0.241721 → 0.491721, u -0.75 → -1.5, v -0.12868 → 0

";
    assert_eq!(text, expected);
    let (header, rows) = results.table("transitions.csv");
    let expected = "t interface from to kind x y u v bounces x_after y_after u_after v_after \
                    bounces_after rate_from rate_to";
    assert_eq!(header, expected.split_whitespace().collect::<Vec<_>>());
    let kinds: Vec<&str> = rows.iter().map(|row| row[4].as_str()).collect();
    assert_eq!(kinds, ["jumped", "crossed", "jumped", "jumped", "jumped"]);
    assert_eq!(
        rows[0][5..15],
        [
            "0.75", "0.5", "0.75", "-1", "0", "0.75", "0.5", "0.75", "1", "1"
        ]
    );
    assert_eq!(rows[1][1..4], ["step", "upper", "lower"]);
    // nothing is conserved: there is no error to show
    assert!(results.path("phase.svg").exists() && !results.path("conservation.svg").exists());
}

#[test]
fn points_have_discrete_states_and_both_sides_of_a_jump() {
    let options = ["--initial", "y=1,u=0.75", "--end", "5", "--every", "1000"];
    let (_, results) = run(ROOM, &options);
    let (header, rows) = results.table("points.csv");
    assert_eq!(header, ["t", "region", "x", "y", "u", "v", "bounces"]);
    // start and end, and both sides of five transitions
    assert_eq!(rows.len(), 2 + 2 * 5);
    for sides in rows[1..11].chunks(2) {
        assert_eq!(sides[0][0], sides[1][0]);
    }
    assert_eq!(rows[1][1..], ["upper", "0.75", "0.5", "0.75", "-1", "0"]);
    assert_eq!(rows[2][1..], ["upper", "0.75", "0.5", "0.75", "1", "1"]);
    assert_eq!((&*rows[3][1], &*rows[4][1]), ("upper", "lower"));
    assert_eq!(rows[11][6], "2");
}

/// A motor that is switched by where it is, against friction.
const SWITCHES: &str = "system Switches {
    state x, v;
    discrete motor = 1;
    interface hot = x - 1;
    interface cold = x + 1;
    der(x) = v;
    der(v) = 2 * motor - 1 - abs(v) / 4;
    on hot rising { motor = 0; }
    on cold falling { motor = 1; }
}
";

#[test]
fn sides_of_formulas_are_parts_of_a_mode() {
    let (text, results) = run(SWITCHES, &["--end", "12"]);
    let table = "\
t           interface  g      kind     mode
1.50269342  hot        rises  jumped   motor 1 → 0
2.59247989  v          falls  crossed  v > 0 → < 0
4.69403111  cold       falls  jumped   motor 0 → 1
9.39317015  v          rises  crossed  v < 0 → > 0

";
    assert!(text.ends_with(table), "{text}");
    let picture = fs::read_to_string(results.path("phase.svg")).unwrap();
    for label in [
        "motor = 1, v &gt; 0",
        "motor = 0, v &lt; 0",
        "jump",
        "crossing",
        "interface v",
    ] {
        assert!(picture.contains(&format!(">{label}<")), "{label}");
    }
}

/// A ball that bounces without loss, in a state and its velocity.
const BALL: &str = "system Ball {
    state y, v;
    discrete bounces = 0;
    interface floor = y;
    der(y) = v;
    der(v) = -1;
    conserved energy = v^2/2 + y;
    on floor falling { v = -v; bounces = bounces + 1; conserves energy; }
}
";

#[test]
fn a_long_itinerary_is_cut() {
    let (text, results) = run(
        BALL,
        &["--initial", "y=0.5", "--end", "100", "--plane", "t,y"],
    );
    assert!(text.contains("transitions: 50 (50 jumped)\n"), "{text}");
    assert!(
        text.ends_with("\n… and 30 more, which transitions.csv lists\n\n"),
        "{text}"
    );
    assert_eq!(text.matches("jumped  bounces").count(), 20);
    assert_eq!(results.table("transitions.csv").1.len(), 50);
    // many modes have few entries in the legend
    let picture = fs::read_to_string(results.path("phase.svg")).unwrap();
    assert_eq!(picture.matches(">bounces = ").count(), 6);
    assert!(picture.contains(">other modes<") && picture.contains(">trajectory<"));
}

#[test]
fn an_ensemble_tells_where_discrete_states_end() {
    let (folder, path) = file(BALL);
    let ends = folder.path().join("ends.csv");
    let (system, out) = (path.to_str().unwrap(), ends.to_str().unwrap());
    let call = [
        "ensemble",
        system,
        "--initial",
        "y=0.5..0.125:2",
        "--end",
        "6",
        "--out",
        out,
    ];
    texts(pws(&call), 0);
    let text = fs::read_to_string(ends).unwrap();
    let rows: Vec<Vec<&str>> = text.lines().map(|row| row.split(',').collect()).collect();
    let columns = "member y(0) v(0) t region y v bounces steps transitions failure";
    assert_eq!(rows[0], columns.split(' ').collect::<Vec<_>>());
    // at 1, 3, 5, and at 1/2, 3/2, …, 11/2
    assert_eq!([rows[1][7], rows[2][7]], ["3", "6"], "{text}");
}

#[test]
fn a_state_alone_is_drawn_against_time() {
    let heater = "system Heater {
        state T;
        discrete heating = 1;
        interface cold = T - 18;
        interface hot = T - 22;
        der(T) = 5 + 10 * heating - T / 2;
        on cold falling { heating = 1; }
        on hot rising { heating = 0; }
    }";
    let (_, results) = run(heater, &["--initial", "T=12"]);
    let picture = fs::read_to_string(results.path("phase.svg")).unwrap();
    for label in [
        "trajectory",
        "t",
        "heating = 1",
        "heating = 0",
        "interface hot",
    ] {
        assert!(picture.contains(&format!(">{label}<")), "{label}");
    }
}

#[test]
fn what_happened_before_events_accumulate_is_told() {
    let ball = BALL
        .replace("v = -v;", "v = -v / 2;")
        .replace("conserves energy; ", "");
    let (_folder, path) = file(&ball);
    let results = Results::within("out");
    let call = ["run", path.to_str().unwrap(), "--initial", "y=0.5"];
    let [text, error] = texts(results.pws(&call), 1);
    assert!(error.contains("t = 3"), "{error}");
    assert!(
        text.contains("1.00000000  floor      falls  jumped  bounces 0 → 1"),
        "{text}"
    );
    let (_, rows) = results.table("transitions.csv");
    assert!(rows.len() > 20 && rows.iter().all(|row| row[1] == "floor"));
}
