use super::*;

const BOUNDS: HealthBounds = HealthBounds {
    speed: 3.0,
    density_change: 0.1,
    surface_density: 1000.0,
    lost_share: 0.3,
    clustered_share: 0.25,
    force_gap: 0.5,
    energy_growth: 0.25,
    energy_floor: 1.0,
};
const VITALS: Vitals = Vitals {
    time_s: 1.0,
    extent: [0.0, 1.0, 0.0, 1.0],
    lean: 0.0,
    spacing: 0.1,
    energy_residual: 0.0,
    work: 4.0,
    clusters: true,
};

fn water() -> Fluid {
    Fluid::at_rest((0..10).map(|k| [0.1 * f64::from(k) + 0.05, 0.1, 1000.0, 1.0]))
}

fn check_once(health: &mut HealthState, fluid: &Fluid, vitals: &Vitals) -> Result<(), Failure> {
    health.check(&BOUNDS, fluid, vitals, &mut Crowding::default())
}

fn check(spoil: impl Fn(&mut Fluid)) -> Result<u32, FailureKind> {
    let (mut fluid, mut health) = (water(), HealthState::default());
    spoil(&mut fluid);
    let result = check_once(&mut health, &fluid, &VITALS);
    result.map(|()| health.lost).map_err(|failure| failure.kind)
}

#[test]
fn each_bound_has_its_reason() {
    assert_eq!(check(|_| ()), Ok(0));
    assert_eq!(check(|f| f.x[3] = -0.1), Ok(1));
    assert_eq!(check(|f| f.vx[3] = f64::NAN), Err(FailureKind::NotANumber));
    assert_eq!(check(|f| f.vy[3] = -4.0), Err(FailureKind::RunawaySpeed));
    assert_eq!(check(|f| f.density[3] = 1200.0), Err(FailureKind::DensityOutOfBounds));
    assert_eq!(check(|f| f.y[..5].fill(-1.0)), Err(FailureKind::ParticlesLost));
    assert_eq!(check(|f| f.x[1] = f.x[0] + 0.02), Ok(0), "one pair is no cluster");
    let pairs = |f: &mut Fluid| (0..5).for_each(|k| f.x[2 * k + 1] = f.x[2 * k] + 0.02);
    assert_eq!(check(pairs), Err(FailureKind::Clustering));
}

#[test]
fn energy_may_be_lost_but_not_found() {
    let with = |energy_residual| {
        let vitals = Vitals { energy_residual, ..VITALS };
        let mut health = HealthState::default();
        let result = check_once(&mut health, &water(), &vitals).map_err(|failure| failure.kind);
        (result, health.margins.closest())
    };
    assert_eq!(with(100.0), (Ok(()), (0.0, "none")));
    assert_eq!(with(-1.0), (Ok(()), (0.5, "energy growth")));
    assert_eq!(with(-2.1).0, Err(FailureKind::EnergyGrowth));
}

#[test]
fn a_gap_must_last() {
    let mut health = HealthState::default();
    health.see_gap(3.0);
    assert!(check_once(&mut health, &water(), &VITALS).is_ok());
    for _ in 0..20 {
        health.see_gap(0.7);
    }
    let told = check_once(&mut health, &water(), &VITALS).unwrap_err();
    assert_eq!(told.kind, FailureKind::ForceGap);
}

#[test]
fn a_failure_names_time_and_particle() {
    let mut fluid = water();
    fluid.vx[7] = 9.0;
    let told = check_once(&mut HealthState::default(), &fluid, &VITALS).unwrap_err().to_string();
    let expected = "runaway-speed at t = 1.0000 s: particle 7 at x = 0.7500 m, y = 0.1000 m \
                    moves at 9.00 m/s, bound 3.00 m/s";
    assert_eq!(told, expected);
}
