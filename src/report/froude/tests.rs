use super::*;

#[test]
fn scales_are_numbers_above_naught() {
    assert_eq!("20".parse(), Ok(Froude(20.0)));
    assert_eq!("1:20".parse(), Ok(Froude(20.0)));
    // A force at 1e300 was infinite.
    for bad in ["0", "-1", "nan", "inf", "twenty", "20:1", "1e300", "1e-300"] {
        let told = bad.parse::<Froude>().unwrap_err();
        assert!(told.starts_with("must be a number from 1e-6 to 1e6"), "{told}");
    }
}

#[test]
fn still_water_has_the_hydrostatics_of_the_prototype() {
    let file = "name = \"a\"\n[scene]\nwave_height_ratio = 0\nend_time_s = 1";
    let row = [(&FORCE_MAX, 1.0), (&MOMENT_MAX, 1.0), (&RUNUP_MAX, 0.5), (&RISE_TIME, 0.1)];
    let over = [(&OVERTOPPING_VOLUME, 0.002), (&OVERTOPPING_DISCHARGE, 0.01)];
    let row = row
        .into_iter()
        .chain(over)
        .fold(Row::default(), |row, (column, value)| row.with(column, value));
    let row = row.with(&crate::quantities::summary::STATUS, "ok").with(&DOUBTFUL, true);
    // The story: the prototype's numbers had no error bars, and nothing showed doubts.
    let row = row.with(&FORCE_MAX_ERROR, 0.1).with(&OVERTOPPING_VOLUME_ERROR, 0.001);
    let row = row.with(&DISPLACEMENT_MAX, 0.5).with(&DISPLACEMENT_TRUNCATED, true);
    let data = Loaded { rows: vec![row], ..Loaded::default() }.made_from(file, &[]);
    let tables = Froude(20.0).tables(&data).unwrap();
    let [table] = &tables[..] else { panic!("{tables:?}") };
    assert!(table.title.ends_with("Froude scale 1:20"));
    let value = |name: &str| {
        let at = table.header.iter().position(|column| column == name).unwrap();
        table.rows[0][at].parse::<f64>().unwrap()
    };
    // Water 4 m deep: ρgh²/2 = 78.48 kN/m, ρgh³/6 = 104.64 kN m/m.
    for (name, exact) in [
        ("still_water_depth_m", 4.0),
        ("force_max_kn_per_m", 78.48),
        ("moment_max_kn_m_per_m", 104.64),
        ("force_max_error_kn_per_m", 7.848),
        ("runup_max_m", 2.0),
        ("rise_time_s", 0.1 * 20.0_f64.sqrt()),
        ("overtopping_volume_m2", 0.8),
        ("overtopping_volume_error_m2", 0.4),
        ("overtopping_discharge_max_m2_per_s", 0.01 * 20.0_f64.powf(1.5)),
    ] {
        assert!((value(name) / exact - 1.0).abs() < 1e-5, "{name}: {}", value(name));
    }
    assert_eq!(table.header.iter().zip(&table.rows[0]).next_back().unwrap().1, "true");
    // The story: on the page bars stood in columns of their own, and a lower bound looked like a number.
    let page = Froude::for_page(table);
    let shown = |name: &str| {
        let at = page.header.iter().position(|column| column == name);
        at.map_or("", |at| &page.rows[0][at])
    };
    assert_eq!(shown("force_max_kn_per_m"), crate::report::number::with_error(78.48, 7.848));
    assert_eq!(shown("displacement_max_m"), "≥ 2");
    assert_eq!([shown("force_max_error_kn_per_m"), shown("displacement_truncated")], [""; 2]);
    assert!(Froude(20.0).tables(&Loaded::default()).unwrap().is_empty());
}
