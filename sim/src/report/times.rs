//! Where the time of a decider goes, as a table: by the clock of this machine, so never the same twice.

use super::grid::Grid;
use crate::sweep::{CycleTimes, Stopwatch};
use std::time::Duration;

/// A line per task, in the order in which they ran, and one for whole answers. What the lines leave of that is the rest
/// of the planner: the frame in the coordinates of its lines, and the fallbacks. Milliseconds.
pub fn times_to_table(watch: &Stopwatch) -> String {
    let mut grid = Grid::new(["time, ms", "times", "median", "p99", "longest"]);
    for (task, times) in &watch.tasks {
        grid.row(row(task.to_string(), times));
    }
    grid.row(row("whole answer".to_owned(), &watch.cycles));
    grid.lines().map(|line| line + "\n").collect()
}

fn row(name: String, times: &CycleTimes) -> [String; 5] {
    let ms = |time: Duration| format!("{:.3}", time.as_secs_f64() * 1e3);
    [
        name,
        times.count().to_string(),
        ms(times.quantile(0.5)),
        ms(times.quantile(0.99)),
        ms(times.longest()),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closed_loop::Sink;
    use corridor_decider::planner::TaskName;

    #[test]
    fn every_task_has_its_line_in_the_order_of_the_first_tick() {
        let mut watch = Stopwatch::default();
        for _ in 0..3 {
            watch.deciding();
            for task in [TaskName::Rss, TaskName::PathBounds] {
                watch.begins(task);
                watch.ended(task);
            }
            watch.decided();
        }
        let table = times_to_table(&watch);
        let first = |line: &str| line.split("  ").next().unwrap_or_default().to_owned();
        let names: Vec<String> = table.lines().map(first).collect();
        assert_eq!(names, ["time, ms", "rss", "path_bounds", "whole answer"]);
        assert!(
            table.lines().skip(1).all(|line| line.contains("  3  ")),
            "{table}"
        );
    }
}
