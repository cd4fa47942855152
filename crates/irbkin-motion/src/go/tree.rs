//! A tree of joint vectors: the motion from each to its parent is free.

use alloc::vec::Vec;

/// Joint vectors with the places of their parents; a root is its own.
pub(super) struct Tree<const N: usize> {
    q: Vec<[f64; N]>,
    parents: Vec<usize>,
}

impl<const N: usize> Tree<N> {
    pub(super) fn new(roots: Vec<[f64; N]>) -> Self {
        Self { parents: (0..roots.len()).collect(), q: roots }
    }

    pub(super) fn len(&self) -> usize {
        self.q.len()
    }

    pub(super) fn at(&self, node: usize) -> &[f64; N] {
        &self.q[node]
    }

    pub(super) fn add(&mut self, q: [f64; N], parent: usize) -> usize {
        self.q.push(q);
        self.parents.push(parent);
        self.q.len() - 1
    }

    /// The node that is nearest to a joint vector.
    pub(super) fn nearest(&self, to: &[f64; N]) -> usize {
        let (mut best, mut least) = (0, f64::INFINITY);
        for (node, q) in self.q.iter().enumerate() {
            let square = q.iter().zip(to).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
            if square < least {
                (best, least) = (node, square);
            }
        }
        best
    }

    /// The joint vectors from a node to its root.
    pub(super) fn to_root(&self, mut node: usize) -> Vec<[f64; N]> {
        let mut path = Vec::from([self.q[node]]);
        while self.parents[node] != node {
            node = self.parents[node];
            path.push(self.q[node]);
        }
        path
    }
}
