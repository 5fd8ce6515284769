use super::*;

fn beach() -> Profile {
    let points = vec![[0.0, 0.0], [2.0, 0.0], [3.0, 0.5], [3.0, 0.7], [4.0, 0.7]];
    Profile::checked(points).unwrap()
}

#[test]
fn heights_ends_and_areas_are_those_of_the_line() {
    let bed = beach();
    let heights = [-1.0, 1.0, 2.5, 2.9999999, 3.0, 3.5, 9.0].map(|x| bed.height(x));
    let exact = [0.0, 0.0, 0.25, 0.49999995, 0.7, 0.7, 0.7];
    assert!(heights.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-12), "{heights:?}");
    assert_eq!((bed.level_up_to(), bed.ends_level(), bed.range()), (2.0, true, [0.0, 0.7]));
    assert!((bed.area_below(1.0) - (2.0 + 0.75 + 0.3)).abs() < 1e-12);
    assert!((bed.area_below(0.25) - (0.5 + 0.5 * 0.5 * 0.25)).abs() < 1e-12);
}

#[test]
fn a_bed_ends_under_still_water_or_dry_or_in_a_lagoon() {
    let bed = beach();
    assert!(bed.ends_dry(0.7, 0.71) && !bed.ends_dry(0.7, 0.7) && !bed.ends_dry(0.71, 0.9));
    let bar = vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.7], [3.0, 0.3]];
    let bar = Profile::checked(bar).unwrap();
    let lagoons = [0.3, 0.31, 0.7, 0.71].map(|depth| bar.has_lagoon(depth));
    assert_eq!(lagoons, [false, true, true, false]);
    assert!(![0.5, 0.7, 0.8].iter().any(|&depth| bed.has_lagoon(depth)));
}

#[test]
fn a_shore_rises_where_still_water_is_thin() {
    let rises = |points: &[[f64; 2]], thickness: f64| {
        Profile::checked(points.to_vec()).unwrap().rises_where_thinner(0.5, thickness)
    };
    let plane = [[0.0, 0.0], [1.0, 0.0], [4.0, 0.9], [5.0, 0.9]];
    assert!(rises(&plane, 0.1) && rises(&plane, 0.5));
    let terrace = [[0.0, 0.0], [1.0, 0.4], [2.0, 0.4], [3.0, 0.6]];
    assert!(rises(&terrace, 0.1) && !rises(&terrace, 0.11));
    let bar = [[0.0, 0.0], [1.0, 0.4], [2.0, 0.3], [3.0, 0.6]];
    assert!(rises(&bar, 0.1) && !rises(&bar, 0.11));
    let trough = [[0.0, 0.0], [1.0, 0.6], [2.0, 0.55], [3.0, 0.7]];
    assert!(!rises(&trough, 0.1));
}

#[test]
fn no_place_between_is_higher_than_the_highest() {
    let bed = beach();
    for (left, right, highest) in
        [(0.5, 1.5, 0.0), (1.5, 2.5, 0.25), (2.9, 3.1, 0.7), (2.5, 2.5, 0.25), (-2.0, 9.0, 0.7)]
    {
        let found = bed.highest_between(left, right);
        assert!((found - highest).abs() < 1e-12, "{left} to {right}: {found}");
        let within = |k: u32| bed.height(left + (right - left) * f64::from(k) / 100.0);
        assert!((0..=100).map(within).all(|height| height <= found + 1e-12));
    }
}

#[test]
fn the_nearest_face_is_found_on_both_sides() {
    let bed = beach();
    for (place, behind, normal) in [
        ([1.0, 0.2], -0.2, [0.0, -1.0]),
        ([1.0, -0.1], 0.1, [0.0, -1.0]),
        ([-0.5, 0.3], -0.3, [0.0, -1.0]),
        ([3.5, 0.6], 0.1, [0.0, -1.0]),
        ([2.9, 0.65], -0.1, [1.0, 0.0]),
    ] {
        let (plane, found) = bed.nearest(place);
        assert!((found - behind).abs() < 1e-12, "{place:?}: {found}");
        let off = (plane.normal[0] - normal[0]).hypot(plane.normal[1] - normal[1]);
        assert!(off < 1e-12, "{place:?}: {plane:?}");
        assert!((plane.beyond(place) - behind).abs() < 1e-12);
    }
    let slope = bed.stretches().nth(1).unwrap();
    let (plane, behind) = bed.nearest(slope.place(0.4, 0.05));
    assert!((behind - 0.05).abs() < 1e-12);
    assert!((plane.normal[1] - slope.normal()[1]).abs() < 1e-9);
}

/// The shore is shallow all the way to dry ground. Water over a bar, or behind one, is not part of
/// it.
#[test]
fn a_shore_begins_where_water_is_shallow_up_to_dry_ground() {
    let bed = |points: &[[f64; 2]]| Profile::checked(points.to_vec()).unwrap();
    let beach = bed(&[[0.0, 0.0], [1.0, 0.0], [3.0, 0.4]]);
    assert!((beach.shore(0.2, 0.05).unwrap() - 1.75).abs() < 1e-12);
    assert_eq!(beach.shore(0.5, 0.05), None);
    let bar = bed(&[[0.0, 0.0], [1.0, 0.18], [2.0, 0.0], [3.0, 0.4]]);
    assert!((bar.shore(0.2, 0.1).unwrap() - 2.25).abs() < 1e-12);
    let step = bed(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.18], [2.0, 0.18], [3.0, 0.3]]);
    assert_eq!(step.shore(0.2, 0.05), Some(1.0));
    assert_eq!(bed(&[[0.0, 0.0], [1.0, 0.15]]).shore(0.2, 0.1), None);
}

/// Neighbours that are all too far away are skipped with one look, and no others are.
#[test]
fn a_look_at_neighbours_misses_no_face_within_reach() {
    let (bed, near) = (beach(), 0.15);
    let mut passed = 0;
    for step in 0..400 {
        let (column, row) = (f64::from(step % 40), f64::from(step / 40));
        let x = [0.0, 0.03, 0.06, 0.09].map(|dx| 0.1 * column + dx);
        let y = [0.02, 0.0, 0.05, 0.01].map(|dy| 0.1 * row + dy);
        let may_be = bed.may_be_within([&x, &y], near);
        let is = x.iter().zip(y).any(|(&x, y)| bed.face_within([x, y], near).is_some());
        assert!(may_be || !is, "{x:?} {y:?}");
        passed += i32::from(!may_be);
    }
    assert!(passed > 150, "{passed}");
}

#[test]
fn what_is_no_bed_is_refused() {
    for (points, told) in [
        (vec![[0.0, 0.0]], "must have two points"),
        (vec![[0.0, 0.0], [1.0, f64::NAN]], "has a point [1, NaN]"),
        (vec![[0.5, 0.0], [1.0, 0.0]], "must begin at [0, 0]"),
        (vec![[0.0, 0.0], [2.0, 0.0], [1.0, 0.1]], "goes back from x = 2 m to 1 m"),
        (vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.0]], "has the point [1, 0] twice"),
    ] {
        let error = Profile::checked(points).unwrap_err();
        assert!(error.starts_with(told), "{error}");
    }
}
