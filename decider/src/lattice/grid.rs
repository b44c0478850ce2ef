//! The times at which everything is sampled.

/// How far ahead the planner looks, s (`trajectory_time_length`).
pub const HORIZON: f64 = 8.0;

/// Time between two samples, s (`trajectory_time_resolution`).
const STEP: f64 = 0.1;

/// Number of samples.
pub const SAMPLES: usize = 81;

/// What belongs to each sample.
pub(super) type Series = [f64; SAMPLES];

/// The times, s. They are added up as the original's are, so that the last one lies just before 8 and a curve of 8 s has
/// not ended there: its jerk counts to the end.
pub const TIMES: [f64; SAMPLES] = added_up();

/// The largest size in a series. Four at once: one after the other each comparison would wait for the last one.
pub(super) fn largest_size(series: &Series) -> f64 {
    let greater = |a: f64, b: f64| if a > b { a } else { b };
    let (fours, rest) = series.as_chunks::<4>();
    let mut largest = [0.0; 4];
    for four in fours {
        for (largest, x) in largest.iter_mut().zip(four) {
            *largest = greater(x.abs(), *largest);
        }
    }
    let sizes = rest.iter().map(|x| x.abs());
    sizes
        .chain(largest)
        .fold(0.0, |largest, size| greater(size, largest))
}

const fn added_up() -> [f64; SAMPLES] {
    let mut times = [0.0; SAMPLES];
    let mut k = 1;
    while k < SAMPLES {
        times[k] = times[k - 1] + STEP;
        k += 1;
    }
    times
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_time_lies_just_before_the_horizon() {
        const { assert!(TIMES[SAMPLES - 1] < HORIZON && TIMES[SAMPLES - 1] > HORIZON - 1e-12) };
    }

    #[test]
    fn the_largest_size_is_found_in_every_place() {
        for k in 0..SAMPLES {
            let mut series = [0.5; SAMPLES];
            series[k] = -2.0;
            assert_eq!(largest_size(&series).to_bits(), 2.0_f64.to_bits(), "{k}");
        }
    }
}
