//! Water between the walls of a tank, and what an exchange makes of it.

use seawall::body::BodyMotion;
use seawall::boundary::{
    Exchange, ExchangeRules, GhostGravity, Ghosts, ImprovedShepard, InterpolatorChoice, TankLayout,
    Water, tank_ghosts,
};
use seawall::kernel::KernelChoice;
use seawall::math::simd::{LANES, SimdPath};
use seawall::pairs::Strips;
use seawall::pairs::{Factors, Flow, Fluid, Record, Scaling};

pub const LENGTH: f64 = 0.6;
pub const DEPTH: f64 = 0.2;
pub const SPACING: f64 = 0.02;
pub const RADIUS: f64 = 0.08;
pub const STRIP: f64 = 0.06;
pub const DENSITY: f64 = 1000.0;
pub const GRAVITY: f64 = 9.81;
/// Water so stiff that its density is the same everywhere.
pub const RIGID: f64 = 1e9;
/// None of the bodies leaves its acceleration out of the ghosts' pressure.
pub const NOBODY: usize = usize::MAX;
pub const PADDLE: usize = 1;
pub const WALL: usize = 2;

/// Those that take a coincident particle's own value.
pub const SHEPARD: &[InterpolatorChoice] = &[
    InterpolatorChoice::ImprovedShepard(ImprovedShepard { lambda: 2.0, sigma: 1.0 }),
    InterpolatorChoice::ImprovedShepard(ImprovedShepard { lambda: 1.0, sigma: 1.0 }),
    InterpolatorChoice::ImprovedShepard(ImprovedShepard { lambda: 4.0, sigma: 2.0 }),
    InterpolatorChoice::ImprovedShepard(ImprovedShepard { lambda: 3.0, sigma: 0.0 }),
];

/// Runs a check with every interpolator on every instruction set, and with every kernel.
pub fn everywhere(check: impl Fn(&dyn Fn(&mut Basin))) {
    with_each(&InterpolatorChoice::every(), check);
}

pub fn with_each(interpolators: &[InterpolatorChoice], check: impl Fn(&dyn Fn(&mut Basin))) {
    let paths = [SimdPath::Portable, SimdPath::Avx2, SimdPath::Avx512];
    for path in paths.into_iter().filter(|path| path.is_supported()) {
        for &interpolator in interpolators {
            let kernel = KernelChoice::WendlandC2;
            check(&|basin: &mut Basin| basin.choose(path, interpolator, kernel));
        }
    }
    for kernel in KernelChoice::ALL {
        let path = SimdPath::widest();
        check(&|basin: &mut Basin| basin.choose(path, interpolators[0], kernel));
    }
}

/// Water with a pressure and a velocity given by its place, between the walls of a tank.
pub struct Basin {
    pub path: SimdPath,
    pub rules: ExchangeRules,
    pub ghosts: Ghosts,
    pub bodies: [BodyMotion; 3],
    pub fluid: Fluid,
    pub strips: Strips,
    pub responds: usize,
    /// The water's, m/s².
    pub acceleration: [f64; 2],
}

/// What an exchange wrote.
pub struct Filled {
    pub records: Vec<Record>,
    pub responses: Vec<[f64; 3]>,
}

impl Basin {
    pub fn new(points: &[[f64; 2]], bodies: [BodyMotion; 3]) -> Basin {
        let layout = TankLayout {
            length: LENGTH,
            spacing_x: SPACING,
            spacing_y: SPACING,
            support_radius: RADIUS,
            wall_height: 3.0 * DEPTH,
            bed_beyond_wall: 4.0 * DEPTH,
            bed_before_paddle: 0.0,
            wall_angle_deg: 90.0,
            still_level: DEPTH,
            dry_bed: false,
            crest: None,
        };
        let kernel = KernelChoice::WendlandC2;
        let volume = SPACING * SPACING;
        let mut fluid =
            Fluid::at_rest(points.iter().map(|&[x, y]| [x, y, DENSITY, DENSITY * volume]));
        let len = fluid.len();
        let (strips, order) = Strips::sort(&fluid.x[..len], &fluid.y[..len], &fluid.id, STRIP);
        fluid.reorder(&order, &mut Vec::new());
        Basin {
            path: SimdPath::Portable,
            rules: ExchangeRules {
                kernel,
                interpolator: SHEPARD[0],
                scaling: Scaling::new(kernel, RADIUS),
                spacing: SPACING,
                gravity: GRAVITY,
                surface_density: DENSITY,
                sound_speed: RIGID,
                ghost_gravity: GhostGravity::InSum,
                no_slip: false,
                bed_between_walls: true,
                conservative_bed: false,
                conservative_crest: false,
            },
            ghosts: tank_ghosts(&layout, None, STRIP),
            bodies,
            fluid,
            strips,
            responds: NOBODY,
            acceleration: [0.0; 2],
        }
    }

    pub fn choose(
        &mut self,
        path: SimdPath,
        interpolator: InterpolatorChoice,
        kernel: KernelChoice,
    ) {
        self.path = path;
        self.rules.interpolator = interpolator;
        self.rules.kernel = kernel;
        self.rules.scaling = Scaling::new(kernel, RADIUS);
    }

    /// The ghosts, given the water's pressure and velocity at a place.
    pub fn fill(
        &mut self,
        pressure: impl Fn(f64, f64) -> f64,
        velocity: impl Fn(f64, f64) -> [f64; 2],
    ) -> Filled {
        let Basin { path, rules, ghosts, bodies, fluid, strips, responds, acceleration } = self;
        let places = || fluid.x.iter().zip(&fluid.y);
        let pressures: Vec<f64> = places().map(|(&x, &y)| pressure(x, y)).collect();
        let scaling = rules.scaling;
        let water: Vec<Record> = (0..fluid.padded_len())
            .map(|k| {
                let (x, y) = (fluid.x[k], fluid.y[k]);
                let [vx, vy] = velocity(x, y);
                let weight = fluid.mass[k] / fluid.density[k] * scaling.weight_per_volume;
                let (x, y) = (x * scaling.inverse_radius, y * scaling.inverse_radius);
                Record([x, y, vx, vy, weight, pressures[k], 0.0, pressures[k]])
            })
            .collect();
        let mut exchange = Exchange::new(*rules, ghosts);
        let len = fluid.len();
        let places = (&*strips, &fluid.x[..len], &fluid.y[..len]);
        exchange.rebuild(*path, ghosts, bodies, places, 1.2 * RADIUS);
        let all = acceleration.map(|along| vec![along; fluid.padded_len()]);
        let acceleration = all.each_ref().map(Vec::as_slice);
        let read = Water { records: &water, pressure: &pressures, correction: None, acceleration };
        exchange.weigh(*path, ghosts, bodies, read);
        let mut records = vec![Record::default(); ghosts.len()];
        exchange.fill(*path, ghosts, bodies, *responds, &mut records);
        // Velocities may be interpolated anew with the weights at hand: nothing changed, the same;
        // but in the continuity equation, for which that is, every wall is smooth.
        let mut refreshed = records.clone();
        let part = |slot: usize| water.iter().map(|record| record.0[slot]).collect::<Vec<_>>();
        let (vx, vy) = (part(Record::VX), part(Record::VY));
        let flow = Flow { corrected: true, strained: false, diffusing: false, sharing: false };
        let mut numbers = vec![Factors::default(); ghosts.len()];
        let packed = (flow, &mut numbers[..]);
        exchange.refresh_velocities(*path, ghosts, bodies, [&vx, &vy], packed);
        let counts = |record: &&Record| record.0[Record::WEIGHT] != 0.0;
        let images = exchange.images();
        for (g, record) in refreshed.iter_mut().enumerate().filter(|(_, record)| counts(&&**record))
        {
            let [vx, vy] = &images[g / LANES].velocity;
            record.0[Record::VX] = vx[g % LANES];
            record.0[Record::VY] = vy[g % LANES];
            assert_eq!(numbers[g].0[..2], [vx[g % LANES], vy[g % LANES]]);
        }
        if rules.no_slip {
            let mut smooth = Exchange::new(ExchangeRules { no_slip: false, ..*rules }, ghosts);
            smooth.rebuild(*path, ghosts, bodies, places, 1.2 * RADIUS);
            smooth.weigh(*path, ghosts, bodies, read);
            let mut expected = vec![Record::default(); ghosts.len()];
            smooth.fill(*path, ghosts, bodies, *responds, &mut expected);
            assert!(expected.iter().filter(counts).eq(refreshed.iter().filter(counts)));
            assert!(expected != records);
        } else {
            assert!(records == refreshed);
        }
        Filled { records, responses: exchange.responses().to_vec() }
    }

    /// Number, body, place and record of the ghosts that count.
    pub fn wet<'a>(
        &'a self,
        filled: &'a Filled,
    ) -> impl Iterator<Item = (usize, usize, [f64; 2], &'a [f64; 8])> {
        let bodies = self.ghosts.bodies.iter().enumerate();
        bodies.flat_map(move |(number, body)| {
            body.ghosts.clone().filter_map(move |g| {
                let record = &filled.records[g].0;
                let place = [self.ghosts.x[g] + self.bodies[number].offset, self.ghosts.y[g]];
                (record[Record::WEIGHT] != 0.0).then_some((g, number, place, record))
            })
        })
    }
}

/// A lattice of water, each point moved by up to `jitter` spacings.
pub fn lattice(jitter: f64) -> Vec<[f64; 2]> {
    let (columns, rows) = ((LENGTH / SPACING).round() as u32, (DEPTH / SPACING).round() as u32);
    let number = |k: u32, factor: f64| 2.0 * (f64::from(k + 1) * factor).fract() - 1.0;
    (0..columns)
        .flat_map(|column| (0..rows).map(move |row| (column, row)))
        .map(|(column, row)| {
            let k = column * rows + row;
            let shift = [number(k, 0.618_033_988), number(k, 0.754_877_666)];
            let at = |index: u32, shift: f64| (f64::from(index) + 0.5 + jitter * shift) * SPACING;
            [at(column, shift[0]), at(row, shift[1])]
        })
        .collect()
}

pub fn still() -> [BodyMotion; 3] {
    [BodyMotion::default(); 3]
}

pub fn assert_close(a: f64, b: f64, tolerance: f64, what: &str) {
    assert!((a - b).abs() <= tolerance, "{what}: {a} instead of {b}");
}
