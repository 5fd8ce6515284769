use super::*;
use crate::keys::Shape;

fn smooth(time: f64) -> f64 {
    0.1 - 0.1 * libm::cos(time)
}

#[test]
fn it_goes_through_its_points_smoothly_and_stays_at_the_last() {
    // Uneven times, and rest at both ends: half a period of a cosine.
    let times: Vec<_> = (0..=20).map(|k| f64::from(k) / 20.0).collect();
    let times = times.iter().map(|s| std::f64::consts::PI * s * (0.7 + 0.3 * s));
    let points: Vec<_> = times.map(|time| [time, 5.0 + smooth(time)]).collect();
    let end = points[20][0];
    let paddle = RecordedStroke::new(&Stroke::checked(points.clone(), &[]).unwrap());
    for &[time, place] in &points {
        assert!((paddle.motion(time).offset - (place - 5.0)).abs() < 1e-15);
        let [before, after] = [-1e-9, 1e-9].map(|off| paddle.motion(time + off));
        assert!((before.velocity - after.velocity).abs() < 1e-9);
        let inside = time > 0.0 && time < end;
        assert!(!inside || (before.acceleration - after.acceleration).abs() < 1e-6);
    }
    for k in 0..100 {
        let time = end * f64::from(k) / 100.0;
        let motion = paddle.motion(time);
        assert!((motion.offset - smooth(time)).abs() < 1e-6, "{time}");
        assert!((motion.velocity - 0.1 * libm::sin(time)).abs() < 1e-4, "{time}");
        assert!((motion.acceleration - 0.1 * libm::cos(time)).abs() < 2e-3, "{time}");
    }
    let later = paddle.motion(end + 1.0);
    assert_eq!((later.offset, later.velocity), (points[20][1] - 5.0, 0.0));
    assert_eq!(paddle.still_from(), end);
}

/// Three points with a step once drew the paddle back by more than the stroke, to where there was
/// no bed.
#[test]
fn what_the_spline_does_between_its_points_counts() {
    let points = vec![[0.0, 0.0], [1.0, 0.0], [1.1, 0.15], [3.0, 0.15]];
    let stroke = Stroke::checked(points.clone(), &[]).unwrap();
    let paddle = RecordedStroke::new(&stroke);
    let [mut back, mut forth] = [0.0_f64; 2];
    for k in 0..30_000 {
        let at = paddle.motion(1e-4 * f64::from(k)).offset;
        (back, forth) = (back.min(at), forth.max(at));
    }
    assert!((paddle.goes_back() + back).abs() < 1e-7 && (paddle.goes_forth() - forth).abs() < 1e-7);
    assert!(paddle.goes_back() > 0.15 && paddle.goes_forth() > 0.3, "{:?}", paddle.range);
    assert_eq!(stroke.reach(), paddle.goes_forth().max(paddle.goes_back()));
    assert!(
        (stroke.overshoot() - paddle.goes_back().max(paddle.goes_forth() - 0.15)).abs() < 1e-12
    );
    let even = Stroke::checked(vec![[0.0, 0.0], [1.0, 0.1], [2.0, 0.2]], &[]).unwrap();
    assert!(even.overshoot() < 1e-12 && (even.reach() - 0.2).abs() < 1e-12);
}

/// Half a second of a measured stroke was missing, and the spline through the rest was once
/// accepted silently.
#[test]
fn a_hole_that_the_stroke_moves_across_is_found() {
    let points = |without: std::ops::Range<usize>| {
        let kept = (0..=60).filter(|k| !without.contains(k)).map(|k| 0.05 * k as f64);
        Stroke::checked(kept.map(|time| [time, smooth(time)]).collect(), &[]).unwrap()
    };
    assert_eq!(points(0..0).hole(), None);
    assert_eq!(points(20..23).hole(), None, "four times as far is no hole");
    let ([before, after], usual) = points(20..30).hole().unwrap();
    assert!((before[0] - 0.95).abs() < 1e-12 && (after[0] - 1.5).abs() < 1e-12, "{before:?}");
    assert!((usual - 0.05).abs() < 1e-12);
    let resting = [[0.0, 0.0], [0.1, 0.1], [0.2, 0.2], [0.3, 0.2], [9.0, 0.2], [9.1, 0.2]];
    assert_eq!(Stroke::checked(resting.to_vec(), &[]).unwrap().hole(), None, "it stands there");
}

/// The story: a recorded train had the numerics of a single wave, and lost four times the energy to viscosity.
#[test]
fn strokes_that_go_back_and_forth_make_one_wave_after_another() {
    let goes_on = |place: &dyn Fn(f64) -> f64| {
        let points = (0..=400).map(|k| 0.02 * f64::from(k)).map(|time| [time, place(time)]);
        Stroke::checked(points.collect(), &[]).unwrap().goes_on()
    };
    let wave = |time: f64| 0.1 * libm::sin(2.0 * std::f64::consts::PI * time);
    let forth = |time: f64| libm::tanh(2.0 * (time - 4.0));
    // Parts of a train: of a period and a half it turns three times.
    assert!(
        goes_on(&wave)
            && goes_on(&|time| wave(time.min(1.5)))
            && goes_on(&|time| -wave(time.min(1.5)))
    );
    assert!(!goes_on(&|time| wave(time.min(1.0))) && !goes_on(&|_| 0.0) && !goes_on(&forth));
    assert!(!goes_on(&|time| forth(2.0 * time) - forth(2.0 * time - 6.0)), "forth and back");
    assert!(!goes_on(&|time| forth(time) + 0.04 * wave(7.0 * time)), "a gauge that trembles");
    assert!(goes_on(&|time| wave(time) * libm::exp(-(time - 4.0) * (time - 4.0))), "a group");
}

#[test]
fn a_file_gives_its_path() {
    assert_eq!(Shape::of::<Stroke>(), Shape::Text);
}

#[test]
fn a_bad_file_is_told_with_its_line() {
    let told = |text: &[u8]| {
        let file = std::env::temp_dir().join(format!("stroke_{}.csv", std::process::id()));
        std::fs::write(&file, text).unwrap();
        let read = Stroke::read(file.to_str().unwrap());
        std::fs::remove_file(file).unwrap();
        read.map(|stroke| stroke.0.points.len())
    };
    assert_eq!(told(b"time_s,stroke_m\n0,0\n1, 0.1\n2,0.3\n"), Ok(3));
    let of_latin = told(b"time_s,stroke_m\n0,0\n1,\xb5\n").unwrap_err();
    assert_eq!(of_latin, "line 3: is not UTF-8 text");
    assert_eq!(told(b"\xff\xfet\0i\0").unwrap_err(), "line 1: is not UTF-8 text");
    let bad = [
        (
            "stroke_m,time_s\n0,0\n",
            "must be a CSV file with the columns time_s and stroke_m, in this order and alone; its \
             first line is \"stroke_m,time_s\"",
        ),
        ("time_s,stroke_m\n0,0\n1,a\n", "line 3: \"a\" is no number"),
        ("time_s,stroke_m\n0,0\n1,2\n", "must have three points or more"),
        ("time_s,stroke_m\n-1,0\n2,0\n3,0\n", "line 2: must begin at 0 s or later, not at -1 s"),
        ("time_s,stroke_m\n0,0\n2,0\n1,0\n", "line 4: goes from 2 s back to 1 s"),
        ("time_s,stroke_m\n0,0\n1,0\n1,0\n", "line 4: has two points at 1 s: times must rise"),
        ("time_s,stroke_m\n0,0\n1,inf\n2,0\n", "line 3: has a point at 1 s, inf m: both"),
    ];
    for (text, message) in bad {
        let told = told(text.as_bytes()).unwrap_err();
        assert!(told.starts_with(message), "{told}");
    }
    assert!(Stroke::read("no/such/file.csv").unwrap_err().starts_with("cannot be read"));
}
