use super::*;

#[test]
fn what_changed_since_it_was_made_is_told() {
    let root = tempfile::tempdir().unwrap();
    let (directory, film) = (root.path(), root.path().join("films/a.html"));
    for folder in FOLDERS {
        fs::create_dir(directory.join(folder)).unwrap();
    }
    fs::create_dir(directory.join("vtk/a")).unwrap();
    let write = |name: &str, text: &str| fs::write(directory.join(name), text).unwrap();
    let names = ["report.html", "figures/a.svg", "films/a.html", "tables/a.csv", "vtk/a/b.vtu"];
    names.iter().for_each(|name| write(name, "old"));
    assert!(damage(directory)[0].starts_with("derived.json is missing: nothing tells what page"));
    Derived::renew(directory, &[directory.join("films/b.html")]).unwrap();
    assert!(!directory.join(FILE_NAME).exists());
    Derived::renew(directory, std::slice::from_ref(&film)).unwrap();
    Derived::begin(directory, MADE_BY_RUNS).unwrap();
    Derived::end(directory, &[], false).unwrap();
    assert!(damage(directory).is_empty());
    names.iter().for_each(|name| write(name, "new"));
    let told = ["figures/a.svg", "films/a.html", "report.html", "tables/a.csv", "vtk/a/b.vtu"];
    assert_eq!(damage(directory), told.map(|name| format!("{name} is damaged")));
    // Making all again repairs all except films.
    Derived::begin(directory, MADE_BY_RUNS).unwrap();
    Derived::end(directory, &[], false).unwrap();
    assert_eq!(damage(directory), ["films/a.html is damaged", "vtk/a/b.vtu is damaged"]);
    // A report must not make the choices of a sweep.
    write("max_error.csv", "old");
    Derived::end(directory, &[], false).unwrap();
    write("max_error.csv", "new");
    Derived::begin(directory, MADE_BY_SWEEPS).unwrap();
    Derived::end(directory, &[], false).unwrap();
    assert_eq!(damage(directory)[1], "max_error.csv is damaged");
    Derived::begin(directory, MADE_BY_RUNS).unwrap();
    Derived::end(directory, &[], false).unwrap();
    assert_eq!(damage(directory).len(), 2);
    fs::remove_file(directory.join("vtk/a/b.vtu")).unwrap();
    Derived::renew_folder(directory, "vtk").unwrap();
    assert_eq!(damage(directory), ["films/a.html is damaged"]);
    assert!(Derived::is_damaged(directory, std::slice::from_ref(&film)));
    Derived::renew(directory, std::slice::from_ref(&film)).unwrap();
    assert!(damage(directory).is_empty());
    fs::remove_file(&film).unwrap();
    assert_eq!(damage(directory), ["films/a.html is missing"]);
    // A film that was not made again, because a directory was in its way, was once forgotten.
    fs::create_dir(&film).unwrap();
    Derived::renew(directory, std::slice::from_ref(&film)).unwrap();
    assert_eq!(damage(directory), ["films/a.html is a directory"]);
    fs::remove_dir(&film).unwrap();
    // So was one with a file in the place of its folder.
    fs::remove_dir(directory.join("films")).unwrap();
    write("films", "a file");
    Derived::renew(directory, std::slice::from_ref(&film)).unwrap();
    assert_eq!(damage(directory), ["films/a.html is missing"]);
    fs::remove_file(directory.join("films")).unwrap();
    Derived::renew(directory, &[film]).unwrap();
    assert!(damage(directory).is_empty());
    write(FILE_NAME, "{}");
    assert!(damage(directory)[0].starts_with("derived.json is damaged: nothing tells what page"));
    Derived::begin(directory, MADE_BY_RUNS).unwrap();
    Derived::end(directory, &[], false).unwrap();
    assert!(damage(directory).is_empty());
}

/// A sweep that had run its cases was once called finished, even if it had not made the files after
/// them.
#[test]
fn a_sweep_owes_until_all_is_made() {
    let root = tempfile::tempdir().unwrap();
    let directory = root.path();
    assert!(!Derived::is_owed(directory));
    Derived::owe(directory).unwrap();
    Derived::begin(directory, MADE_BY_SWEEPS).unwrap();
    Derived::end(directory, &[], false).unwrap();
    assert!(Derived::is_owed(directory), "a report alone makes no films");
    Derived::end(directory, &[], true).unwrap();
    assert!(!Derived::is_owed(directory));
}

/// The story: a report dropped the seals and was killed. Then nothing told that a figure was cut.
#[test]
fn a_report_that_does_not_end_leaves_a_note() {
    let root = tempfile::tempdir().unwrap();
    let directory = root.path();
    fs::create_dir(directory.join("figures")).unwrap();
    let cut = directory.join("figures/a.svg.partial");
    fs::write(&cut, "<svg").unwrap();
    assert!(!Derived::is_cut(directory));
    Derived::begin(directory, MADE_BY_SWEEPS).unwrap();
    assert!(Derived::is_cut(directory) && !Derived::is_owed(directory));
    assert_eq!(damage(directory), [CUT]);
    assert!(!cut.exists(), "a killed process has left it");
    let making = Making::hold(directory, || {});
    assert!(!Derived::is_cut(directory) && damage(directory).is_empty(), "it is still at work");
    drop(making);
    Derived::end(directory, &[], false).unwrap();
    assert!(!Derived::is_cut(directory) && damage(directory).is_empty());
    Derived::owe(directory).unwrap();
    assert_eq!(damage(directory), [CUT]);
}

/// A continued study may no longer have a figure. The old one once stayed and was sealed as new.
#[test]
fn what_a_report_has_no_more_is_removed_and_nothing_else() {
    let root = tempfile::tempdir().unwrap();
    let directory = root.path();
    let names = ["figures/a.svg", "figures/b.svg", "figures/own.svg", "tables/a.csv"];
    for folder in ["figures", "tables"] {
        fs::create_dir(directory.join(folder)).unwrap();
    }
    names.iter().for_each(|name| fs::write(directory.join(name), "text").unwrap());
    let report = |made: &[&str]| {
        Derived::begin(directory, MADE_BY_SWEEPS).unwrap();
        let made: Vec<_> = made.iter().map(|&name| name.to_owned()).collect();
        Derived::end(directory, &made, false).unwrap();
        assert!(damage(directory).is_empty());
        names.map(|name| directory.join(name).exists())
    };
    assert_eq!(report(&[names[0], names[1], names[3]]), [true; 4]);
    // A process that dies on the way does not lose the list.
    Derived::begin(directory, MADE_BY_SWEEPS).unwrap();
    assert_eq!(report(&[names[1]]), [false, true, true, false]);
    assert_eq!(report(&[names[1]]), [false, true, true, false]);
}

/// Sweep and report once ended with an error, because such a link cannot be sealed.
#[test]
fn a_link_that_leads_nowhere_is_passed_over() {
    let root = tempfile::tempdir().unwrap();
    let directory = root.path();
    fs::create_dir(directory.join("figures")).unwrap();
    std::os::unix::fs::symlink("nowhere", directory.join("figures/own.svg")).unwrap();
    Derived::end(directory, &[], true).unwrap();
    assert!(damage(directory).is_empty());
}
