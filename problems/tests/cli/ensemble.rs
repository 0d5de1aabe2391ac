//! `pws ensemble`: a row for each member, the bad ones included.

use std::fs;

use super::{pws, refusal, texts};

/// The rows of a file of results, by column.
fn rows(text: &str) -> Vec<Vec<(String, String)>> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader.headers().unwrap().clone();
    let records = reader.records().map(|record| {
        let record = record.unwrap();
        let pairs = header.iter().zip(record.iter());
        pairs.map(|(a, b)| (a.to_owned(), b.to_owned())).collect()
    });
    records.collect()
}

fn field<'a>(row: &'a [(String, String)], name: &str) -> &'a str {
    let found = row.iter().find(|(column, _)| column == name);
    &found.unwrap_or_else(|| panic!("no column {name}")).1
}

#[test]
fn ranges_become_rows() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("ends.csv");
    let call = pws(&[
        "ensemble",
        "elliptic",
        "--scheme",
        "taylor",
        "--end",
        "3",
        "--param",
        "a_outside=-2..-1.9:3",
        "--initial",
        "y=-1..-0.9:2",
        "--out",
        out.to_str().unwrap(),
    ]);
    let [said, _] = texts(call, 0);
    assert!(said.contains("6 trajectories until t = 3"), "{said}");
    let rows = rows(&fs::read_to_string(&out).unwrap());
    assert_eq!(rows.len(), 6);
    for (number, row) in rows.iter().enumerate() {
        assert_eq!(field(row, "member"), number.to_string());
        assert_eq!(field(row, "a_inside"), "-3");
        assert_eq!(field(row, "a_outside"), ["-2", "-1.95", "-1.9"][number / 2]);
        assert_eq!(field(row, "y(0)"), ["-1", "-0.9"][number % 2]);
        assert_eq!(field(row, "t"), "3");
        assert_eq!(field(row, "failure"), "");
        // after 2.87 and before 3.51, when the reference crosses the circle
        let value = |name| field(row, name).parse::<f64>().unwrap();
        assert_eq!(field(row, "region"), "inside");
        assert_eq!(field(row, "transitions"), "3");
        assert!(value("x").hypot(value("y")) < 1.0);
    }
}

#[test]
fn bad_rows_of_a_file_do_not_lose_the_others() {
    let directory = tempfile::tempdir().unwrap();
    let (members, out) = (
        directory.path().join("members.csv"),
        directory.path().join("ends.csv"),
    );
    let text = "x,k_below\n1,3\n2,three\n1\n0.5,2\n";
    fs::write(&members, text).unwrap();
    let paths = [&members, &out].map(|path| path.to_str().unwrap());
    let call = pws(&[
        "ensemble",
        "harmonic",
        "--members",
        paths[0],
        "--end",
        "1",
        "--out",
        paths[1],
    ]);
    let [_, error] = texts(call, 1);
    assert!(error.contains("2 of 4 trajectories failed"), "{error}");
    let rows = rows(&fs::read_to_string(&out).unwrap());
    assert_eq!(rows.len(), 4);
    let failures: Vec<&str> = rows.iter().map(|row| field(row, "failure")).collect();
    assert!(failures[1].contains("line 3, column `k_below`: `three` is not a finite number"));
    assert!(failures[2].contains("line 4: 1 values where the header has 2"));
    assert_eq!([failures[0], failures[3]], ["", ""]);
    assert_eq!(field(&rows[3], "k_below"), "2");
    assert_eq!(field(&rows[3], "x(0)"), "0.5");
    assert_eq!(field(&rows[3], "t"), "1");
}

#[test]
fn what_makes_no_members_is_refused() {
    let initial = |value| refusal(&["ensemble", "elliptic", "--initial", value]);
    assert!(initial("x=1..2").contains("says not how many"));
    assert!(initial("z=1..2:3").contains("there are x, y"));
    assert!(refusal(&["ensemble", "elliptic", "--members", "nosuch.csv"]).contains("cannot read"));
}

#[test]
#[cfg(not(feature = "parquet"))]
fn parquet_has_to_be_asked_for() {
    let said = refusal(&["ensemble", "elliptic", "--out", "ends.parquet"]);
    assert!(said.contains("`--features parquet`"), "{said}");
}

#[test]
#[cfg(feature = "parquet")]
fn a_parquet_file_says_the_same_as_csv() {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;

    let directory = tempfile::tempdir().unwrap();
    let members = directory.path().join("members.csv");
    fs::write(&members, "x,k_below\n1,3\n2,three\n0.5,2\n").unwrap();
    let [csv, parquet] = ["ends.csv", "ends.parquet"].map(|name| directory.path().join(name));
    for out in [&csv, &parquet] {
        let paths = [&members, out].map(|path| path.to_str().unwrap());
        let scheme = [
            "--scheme",
            "taylor",
            "--members",
            paths[0],
            "--out",
            paths[1],
        ];
        let call = pws(&[["ensemble", "harmonic"].as_slice(), &scheme].concat());
        texts(call, 1);
    }
    let reader = SerializedFileReader::new(fs::File::open(&parquet).unwrap()).unwrap();
    let written = reader.get_row_iter(None).unwrap().map(|row| {
        let row = row.unwrap();
        let fields = row.get_column_iter().map(|(name, field)| {
            let text = match field {
                Field::Null => String::new(),
                Field::Str(text) => text.clone(),
                Field::Long(count) => count.to_string(),
                Field::Double(value) => value.to_string(),
                other => panic!("{name}: {other:?}"),
            };
            (name.clone(), text)
        });
        fields.collect::<Vec<_>>()
    });
    let expected = rows(&fs::read_to_string(&csv).unwrap());
    assert_eq!(expected.len(), 3);
    assert_eq!(written.collect::<Vec<_>>(), expected);
}
