//! Tyre forces of a single-track car, as one impulse per axle and step.
//!
//! Body frame: `x` forward, `y` left, origin at the centre of mass. A tyre's lateral force is its cornering
//! stiffness times its slip angle, `F = −C·v_y/|v_x|`, up to the friction circle that it shares with drive and
//! brakes (Rajamani, *Vehicle Dynamics and Control*, ch. 2). The slip is taken **after** the step, which
//! makes the two lateral impulses the solution of a 2×2 linear system: stable at any speed and step, and at
//! standstill the tyre becomes what it is there, a wheel that cannot move sideways at all.

use super::params::DynamicsParams;
use corridor_decider::vehicle::VehicleParams;

/// Sweeps over the two axles once one of them slides. The axles are weakly coupled; each sweep shrinks the
/// error more than tenfold, and eight leave none that matters.
const SLIDING_SWEEPS: usize = 8;

/// Velocity of the body in its own frame, at the centre of mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BodyVelocity {
    /// Forward, m/s.
    pub(super) forward: f64,
    /// To the left, m/s.
    pub(super) left: f64,
    /// Yaw rate, rad/s.
    pub(super) yaw: f64,
}

/// One axle, its two wheels drawn together on the centre line.
#[derive(Clone, Copy, Debug)]
struct Axle {
    /// Place ahead of the centre of mass, m.
    x: f64,
    /// Cornering stiffness, N/rad.
    stiffness: f64,
    /// Largest force on the road, N.
    grip: f64,
    /// Share of the mass that it carries, and so of the braking.
    load_share: f64,
    /// Share of the drive.
    drive_share: f64,
}

/// Both axles with the body they carry.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axles {
    front: Axle,
    rear: Axle,
    mass: f64,
    yaw_inertia: f64,
    dt: f64,
}

/// An axle with its wheels turned: unit vector along them and along their axis.
#[derive(Clone, Copy)]
struct Wheel {
    axle: Axle,
    along: (f64, f64),
    across: (f64, f64),
}

impl Wheel {
    fn new(axle: Axle, sin: f64, cos: f64) -> Self {
        Self {
            axle,
            along: (cos, sin),
            across: (-sin, cos),
        }
    }

    /// Speed of the axle's middle in direction `axis`.
    fn speed(&self, v: BodyVelocity, axis: (f64, f64)) -> f64 {
        axis.0 * v.forward + axis.1 * (v.left + self.axle.x * v.yaw)
    }
}

impl Axles {
    pub(super) fn new(vehicle: &VehicleParams, params: &DynamicsParams, dt: f64) -> Self {
        let (front_load, rear_load) = params.axle_loads(vehicle);
        let weight = front_load + rear_load;
        let axle = |x, stiffness, load, drive_share| Axle {
            x,
            stiffness,
            grip: params.friction * load,
            load_share: load / weight,
            drive_share,
        };
        let nose = vehicle.wheel_base - params.center_of_mass;
        Self {
            front: axle(nose, params.front_stiffness, front_load, 1.0),
            rear: axle(-params.center_of_mass, params.rear_stiffness, rear_load, 0.0),
            mass: params.mass,
            yaw_inertia: params.yaw_inertia,
            dt,
        }
    }

    /// The velocity after one step with the front wheels at `steer` (rad) and `acceleration` (m/s²) asked of
    /// drive or brakes. Brakes bring the car to rest, never into reverse, and then hold it exactly.
    pub(super) fn step(&self, before: BodyVelocity, steer: f64, acceleration: f64) -> BodyVelocity {
        let (sin, cos) = libm::sincos(steer);
        let wheels = [Wheel::new(self.front, sin, cos), Wheel::new(self.rear, 0.0, 1.0)];
        let (along, v) = self.push(&wheels, before, acceleration);
        let across = self.hold_sideways(&wheels, v, along);
        let mut v = v;
        for (wheel, impulse) in wheels.iter().zip(across) {
            v = self.apply(v, wheel, wheel.across, impulse);
        }
        if self.comes_to_rest(before, v, acceleration) {
            return BodyVelocity {
                forward: 0.0,
                left: 0.0,
                yaw: 0.0,
            };
        }
        v
    }

    /// Whether the brakes take the whole motion within this step.
    fn comes_to_rest(&self, before: BodyVelocity, after: BodyVelocity, acceleration: f64) -> bool {
        let brake = -acceleration * self.dt;
        let turning = after.yaw * (self.front.x - self.rear.x);
        before.forward.abs() <= brake && after.left.abs() < brake && turning.abs() < brake
    }

    /// Drive or brake impulses along the wheels, and the velocity after them.
    fn push(&self, wheels: &[Wheel; 2], before: BodyVelocity, acceleration: f64) -> ([f64; 2], BodyVelocity) {
        let wanted = self.mass * acceleration.abs() * self.dt;
        let mut impulses = [0.0; 2];
        let mut v = before;
        for (impulse, wheel) in impulses.iter_mut().zip(wheels) {
            let grip = wheel.axle.grip * self.dt;
            *impulse = if acceleration >= 0.0 {
                (wanted * wheel.axle.drive_share).min(grip)
            } else {
                let speed = wheel.speed(before, wheel.along);
                let to_rest = self.mass * wheel.axle.load_share * speed.abs();
                -(wanted * wheel.axle.load_share).min(grip).min(to_rest) * speed.signum()
            };
            v = self.apply(v, wheel, wheel.along, *impulse);
        }
        (impulses, v)
    }

    /// Lateral impulses of both axles: `(A + D)·j = −w`, with `A` the inverse mass seen at the axles, `D` the
    /// tyres' give and `w` the lateral speeds; then each kept inside what the friction circle leaves it.
    fn hold_sideways(&self, wheels: &[Wheel; 2], v: BodyVelocity, along: [f64; 2]) -> [f64; 2] {
        let [f, r] = wheels;
        let seen = |a: &Wheel, b: &Wheel| {
            let turn = (a.axle.x * a.across.1) * (b.axle.x * b.across.1) / self.yaw_inertia;
            (a.across.0 * b.across.0 + a.across.1 * b.across.1) / self.mass + turn
        };
        let give = |w: &Wheel| w.speed(v, w.along).abs() / (w.axle.stiffness * self.dt);
        let (ff, rr, fr) = (seen(f, f) + give(f), seen(r, r) + give(r), seen(f, r));
        let (w_f, w_r) = (f.speed(v, f.across), r.speed(v, r.across));
        let determinant = ff * rr - fr * fr;
        let mut j_f = (fr * w_r - rr * w_f) / determinant;
        let mut j_r = (fr * w_f - ff * w_r) / determinant;
        let left_over = |w: &Wheel, used: f64| {
            let grip = w.axle.grip * self.dt;
            (grip * grip - used * used).max(0.0).sqrt()
        };
        let (max_f, max_r) = (left_over(f, along[0]), left_over(r, along[1]));
        if j_f.abs() > max_f || j_r.abs() > max_r {
            for _ in 0..SLIDING_SWEEPS {
                j_f = (-(w_f + fr * j_r) / ff).clamp(-max_f, max_f);
                j_r = (-(w_r + fr * j_f) / rr).clamp(-max_r, max_r);
            }
        }
        [j_f, j_r]
    }

    fn apply(&self, v: BodyVelocity, wheel: &Wheel, axis: (f64, f64), impulse: f64) -> BodyVelocity {
        BodyVelocity {
            forward: v.forward + axis.0 * impulse / self.mass,
            left: v.left + axis.1 * impulse / self.mass,
            yaw: v.yaw + wheel.axle.x * axis.1 * impulse / self.yaw_inertia,
        }
    }
}
