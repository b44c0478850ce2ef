//! `--shard I/N`: which part of a sweep this machine makes.

use corridor_sim::sweep::Shard;

/// Where schedulers tell which task of how many this is: the variable of the index, of the lowest index, and of the count.
/// An index without a lowest one counts from 0. `JOB_COMPLETIONS` is not set by Kubernetes itself: a job hands it on from
/// its own `completions`, or `auto/N` says it.
const SCHEDULERS: [(&str, Option<&str>, &str); 3] = [
    (
        "SLURM_ARRAY_TASK_ID",
        Some("SLURM_ARRAY_TASK_MIN"),
        "SLURM_ARRAY_TASK_COUNT",
    ),
    ("JOB_COMPLETION_INDEX", None, "JOB_COMPLETIONS"),
    ("SLURM_PROCID", None, "SLURM_NTASKS"),
];

/// `I/N` from 1, `auto`, or `auto/N`.
pub(super) fn parse(text: &str) -> Result<Shard, String> {
    parse_with(text, &|name| std::env::var(name).ok())
}

fn parse_with(text: &str, variable: &dyn Fn(&str) -> Option<String>) -> Result<Shard, String> {
    let (part, of) = match text.split_once('/') {
        Some((part, of)) => (part, Some(number(of)?)),
        None => (text, None),
    };
    if part == "auto" {
        return automatic(of, variable);
    }
    let of = of.ok_or("expected `I/N` as in `2/4`, `auto` or `auto/N`")?;
    shard(number(part)?.checked_sub(1), of)
}

/// The part that the scheduler's variables tell.
fn automatic(of: Option<u64>, variable: &dyn Fn(&str) -> Option<String>) -> Result<Shard, String> {
    let found = SCHEDULERS
        .iter()
        .find_map(|scheduler| Some((scheduler, variable(scheduler.0)?)));
    let Some(((name, lowest, count), index)) = found else {
        let names: Vec<&str> = SCHEDULERS.iter().map(|(name, ..)| *name).collect();
        return Err(format!(
            "none of {} is set: name the part as `I/N`",
            names.join(", ")
        ));
    };
    let named = |name: &str, value: &str| number(value).map_err(|problem| format!("{name}: {problem}"));
    let index = named(name, &index)?;
    let lowest = match lowest.and_then(|name| Some((name, variable(name)?))) {
        Some((name, value)) => named(name, &value)?,
        None => 0,
    };
    let of = match (of, variable(count)) {
        (Some(of), _) => of,
        (None, Some(value)) => named(count, &value)?,
        (None, None) => return Err(format!("{name} is set but {count} is not: say `auto/N`")),
    };
    shard(index.checked_sub(lowest), of)
}

fn shard(index: Option<u64>, of: u64) -> Result<Shard, String> {
    match index {
        Some(index) if index < of => Ok(Shard { index, of }),
        _ => Err(format!("the part must be one of 1/{of} to {of}/{of}")),
    }
}

fn number(text: &str) -> Result<u64, String> {
    text.parse()
        .map_err(|_| format!("`{text}` is no number of a part"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(text: &str, variables: &[(&str, &str)]) -> Result<(u64, u64), String> {
        let variable = |name: &str| {
            let found = variables.iter().find(|(known, _)| *known == name);
            found.map(|(_, value)| (*value).to_owned())
        };
        parse_with(text, &variable).map(|shard| (shard.index, shard.of))
    }

    #[test]
    fn parts_are_counted_from_one() {
        assert_eq!(with("1/4", &[]), Ok((0, 4)));
        assert_eq!(with("4/4", &[]), Ok((3, 4)));
        for wrong in ["0/4", "5/4", "4", "1/0", "a/4", "1/", "-1/4", "auto"] {
            assert!(with(wrong, &[]).is_err(), "{wrong}");
        }
    }

    #[test]
    fn schedulers_tell_the_part() {
        let slurm = [
            ("SLURM_ARRAY_TASK_ID", "7"),
            ("SLURM_ARRAY_TASK_MIN", "5"),
            ("SLURM_ARRAY_TASK_COUNT", "4"),
            ("SLURM_PROCID", "0"),
            ("SLURM_NTASKS", "1"),
        ];
        assert_eq!(with("auto", &slurm), Ok((2, 4)));
        assert_eq!(with("auto", &slurm[3..]), Ok((0, 1)));
        let kubernetes = [("JOB_COMPLETION_INDEX", "3")];
        assert_eq!(with("auto/8", &kubernetes), Ok((3, 8)));
        assert!(with("auto", &kubernetes).unwrap_err().contains("auto/N"));
        assert!(with("auto/3", &kubernetes).is_err());
        assert!(
            with("auto", &[("SLURM_PROCID", "x")])
                .unwrap_err()
                .contains("SLURM_PROCID")
        );
    }
}
