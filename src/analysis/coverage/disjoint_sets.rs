//! Things that are linked to each other, and how many groups they form (Tarjan 1975, "Efficiency of a good but not linear
//! set union algorithm").

/// A forest with a tree for each group.
pub(super) struct DisjointSets {
    parents: Vec<u32>,
    count: usize,
}

impl DisjointSets {
    /// As many groups of one.
    pub fn new(members: usize) -> Self {
        Self { parents: (0..members as u32).collect(), count: members }
    }

    /// The number of groups.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Whether two members are of one group.
    pub fn are_linked(&mut self, a: u32, b: u32) -> bool {
        self.root(a) == self.root(b)
    }

    /// Makes one group of those of two members.
    pub fn link(&mut self, a: u32, b: u32) {
        let [a, b] = [self.root(a), self.root(b)];
        if a != b {
            self.parents[a.max(b) as usize] = a.min(b);
            self.count -= 1;
        }
    }

    fn root(&mut self, mut member: u32) -> u32 {
        while self.parents[member as usize] != member {
            let grandparent = self.parents[self.parents[member as usize] as usize];
            self.parents[member as usize] = grandparent;
            member = grandparent;
        }
        member
    }
}
