//! What the elements of an `.osm` file say: nodes, ways and relations by id, in any order, with their tags.

use crate::import::ImportError;
use crate::import::notes::Notes;
use crate::import::xml::{Element, Place};
use std::collections::BTreeMap;

/// Tags of one element by key.
pub(super) type Tags<'a> = BTreeMap<&'a str, &'a str>;

/// A point. Numbers that are absent, empty or no finite numbers are `None`.
#[derive(Clone, Copy, Debug)]
pub(super) struct NodeRecord {
    pub(super) place: Place,
    /// Latitude and longitude, degrees.
    pub(super) geographic: Option<(f64, f64)>,
    /// Metres in the file's own frame.
    pub(super) local: Option<(f64, f64)>,
}

/// A polyline.
#[derive(Debug)]
pub(super) struct WayRecord<'a> {
    pub(super) nodes: Vec<i64>,
    pub(super) tags: Tags<'a>,
}

/// What a relation holds together.
#[derive(Clone, Copy, Debug)]
pub(super) struct Member<'a> {
    /// `node`, `way` or `relation`.
    pub(super) kind: &'a str,
    pub(super) id: i64,
    pub(super) role: &'a str,
}

/// A lanelet, an area or a regulatory element.
#[derive(Debug)]
pub(super) struct RelationRecord<'a> {
    pub(super) place: Place,
    pub(super) id: i64,
    pub(super) members: Vec<Member<'a>>,
    pub(super) tags: Tags<'a>,
}

impl RelationRecord<'_> {
    /// Ids of the members with a kind and a role.
    pub(super) fn members_as(&self, kind: &str, role: &str) -> impl Iterator<Item = i64> {
        let matching = move |member: &&Member<'_>| member.kind == kind && member.role == role;
        self.members.iter().filter(matching).map(|member| member.id)
    }
}

/// A file, unconnected.
#[derive(Debug, Default)]
pub(super) struct File<'a> {
    pub(super) nodes: BTreeMap<i64, NodeRecord>,
    pub(super) ways: BTreeMap<i64, WayRecord<'a>>,
    /// In the order of the file.
    pub(super) relations: Vec<RelationRecord<'a>>,
    /// Place of each relation in the list.
    pub(super) relation_numbers: BTreeMap<i64, usize>,
}

/// Reads all elements of the root that are not marked as deleted. Of those with the same id the first one counts.
pub(super) fn read<'a>(root: Element<'a>, notes: &mut Notes<'_>) -> Result<File<'a>, ImportError> {
    let mut file = File::default();
    for element in root.elements() {
        if !matches!(element.name(), "node" | "way" | "relation") {
            continue;
        }
        let id = element.id("id")?;
        if element.text("action") == Some("delete") {
            notes.add("a deleted element is skipped", element.place(), || {
                format!("{} {id}", element.name())
            });
            continue;
        }
        let again = match element.name() {
            "node" => !insert_new(&mut file.nodes, id, || Ok(node(element)))?,
            "way" => !insert_new(&mut file.ways, id, || way(element))?,
            _ => {
                let number = file.relations.len();
                let new = insert_new(&mut file.relation_numbers, id, || Ok(number))?;
                if new {
                    file.relations.push(relation(element, id)?);
                }
                !new
            }
        };
        if again {
            notes.add("a second element of this id is skipped", element.place(), || {
                format!("{} {id}", element.name())
            });
        }
    }
    Ok(file)
}

/// Whether the id was new.
fn insert_new<T>(
    map: &mut BTreeMap<i64, T>,
    id: i64,
    value: impl FnOnce() -> Result<T, ImportError>,
) -> Result<bool, ImportError> {
    if map.contains_key(&id) {
        return Ok(false);
    }
    map.insert(id, value()?);
    Ok(true)
}

fn node(element: Element<'_>) -> NodeRecord {
    let tags = tags(element);
    let pair = |a: Option<&str>, b: Option<&str>| Some((finite(a?)?, finite(b?)?));
    NodeRecord {
        place: element.place(),
        geographic: pair(element.text("lat"), element.text("lon")),
        local: pair(tags.get("local_x").copied(), tags.get("local_y").copied()),
    }
}

fn finite(text: &str) -> Option<f64> {
    text.trim()
        .parse::<f64>()
        .ok()
        .filter(|number| number.is_finite())
}

fn way(element: Element<'_>) -> Result<WayRecord<'_>, ImportError> {
    let nodes = element.children("nd").map(|nd| nd.id("ref"));
    Ok(WayRecord {
        nodes: nodes.collect::<Result<_, _>>()?,
        tags: tags(element),
    })
}

fn relation<'a>(element: Element<'a>, id: i64) -> Result<RelationRecord<'a>, ImportError> {
    let member = |member: Element<'a>| {
        Ok(Member {
            kind: member.text("type").unwrap_or_default(),
            id: member.id("ref")?,
            role: member.text("role").unwrap_or_default(),
        })
    };
    Ok(RelationRecord {
        place: element.place(),
        id,
        members: element
            .children("member")
            .map(member)
            .collect::<Result<_, ImportError>>()?,
        tags: tags(element),
    })
}

/// All tags that have a key; those without a value say nothing.
fn tags(element: Element<'_>) -> Tags<'_> {
    element
        .children("tag")
        .filter_map(|tag| Some((tag.text("k")?, tag.text("v")?)))
        .collect()
}
