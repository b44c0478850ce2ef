//! Real maps.
#[test]
fn dump() {
    for f in std::fs::read_dir("/work/shared/maps/opendrive").unwrap() {
        let p = f.unwrap().path();
        let t = std::time::Instant::now();
        match corridor_scenarios::import::opendrive::read_file(&p) {
            Err(e) => println!("ERR {e}"),
            Ok(i) => {
                let m = &i.map;
                let mut by = std::collections::BTreeMap::new();
                let mut pts = 0;
                for l in m.lanes() {
                    let e = by.entry(format!("{:?}", l.kind)).or_insert((0, 0.0));
                    e.0 += 1;
                    e.1 += l.length();
                    pts += l.points.len();
                }
                println!(
                    "{} lanes {} pts {pts} junctions {} time {:?}",
                    p.display(),
                    m.lanes().len(),
                    m.junctions().len(),
                    t.elapsed()
                );
                for (k, v) in by {
                    println!("   {k}: {} lanes {:.1} m", v.0, v.1);
                }
                let dead = m
                    .lanes()
                    .iter()
                    .filter(|l| l.kind.is_drivable() && l.successors.is_empty())
                    .count();
                println!("   dead ends {dead}");
                for w in i.warnings {
                    println!("   W {w}");
                }
            }
        }
    }
}
