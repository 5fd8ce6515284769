//! Memory of large arrays on large pages.
//!
//! The processor caches the addresses of a limited number of pages. Water of 80,000 particles and
//! its pairs fill some 20,000 pages of 4 kB, so passes over them wait for addresses. Linux gives
//! pages of 2 MB on request.

use std::alloc::{GlobalAlloc, Layout, System};

use rustix::mm::{Advice, madvise};

/// Bytes of a large page.
const PAGE: usize = 2 << 20;

/// The system's allocator. It asks for large pages for memory that fills at least one. Smaller
/// memory is unchanged.
pub struct LargePages;

/// How memory of this size is laid out on large pages; none if it fills no page.
fn on_large_pages(layout: Layout) -> Option<Layout> {
    (layout.size() >= PAGE).then(|| layout.align_to(PAGE).ok()).flatten()
}

// SAFETY: all memory is the system's. It is freed with the layout that it was had with, as that follows from the
// caller's layout alone. Advice moves nothing and changes no byte.
unsafe impl GlobalAlloc for LargePages {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let large = on_large_pages(layout);
        // SAFETY: the caller's promise is passed on; a larger alignment breaks none.
        let place = unsafe { System.alloc(large.unwrap_or(layout)) };
        if let Some(large) = large.filter(|_| !place.is_null()) {
            // Pages that also hold other data are left out. A refusal only costs speed.
            let whole = large.size() / PAGE * PAGE;
            // SAFETY: the range was allocated above.
            let _ = unsafe { madvise(place.cast(), whole, Advice::LinuxHugepage) };
        }
        place
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        if on_large_pages(layout).is_none() {
            // SAFETY: the caller's promise is passed on as it is.
            return unsafe { System.alloc_zeroed(layout) };
        }
        // SAFETY: as above; what was allocated is as long as asked for.
        unsafe {
            let place = self.alloc(layout);
            if !place.is_null() {
                place.write_bytes(0, layout.size());
            }
            place
        }
    }

    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        // SAFETY: it was allocated with the same layout.
        unsafe { System.dealloc(place, on_large_pages(layout).unwrap_or(layout)) }
    }

    unsafe fn realloc(&self, place: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: the caller promises that this size goes with this alignment.
        let wanted = unsafe { Layout::from_size_align_unchecked(size, layout.align()) };
        if on_large_pages(layout).is_none() && on_large_pages(wanted).is_none() {
            // SAFETY: the caller's promise is passed on as it is.
            return unsafe { System.realloc(place, layout, size) };
        }
        // SAFETY: both are allocated, apart, and as long as the shorter of the two sizes.
        unsafe {
            let to = self.alloc(wanted);
            if !to.is_null() {
                to.copy_from_nonoverlapping(place, layout.size().min(size));
                self.dealloc(place, layout);
            }
            to
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Flags of the mapping that holds an address, as the kernel tells them.
    fn flags(address: usize) -> String {
        let maps = std::fs::read_to_string("/proc/self/smaps").unwrap();
        let mut inside = false;
        for line in maps.lines() {
            let ends = line.split(' ').next().and_then(|range| range.split_once('-'));
            let number = |text| usize::from_str_radix(text, 16);
            if let Some((Ok(start), Ok(end))) =
                ends.map(|(start, end)| (number(start), number(end)))
            {
                inside = (start..end).contains(&address);
            } else if let Some(flags) = line.strip_prefix("VmFlags:").filter(|_| inside) {
                return flags.to_owned();
            }
        }
        panic!("no mapping holds {address:x}")
    }

    #[test]
    fn large_arrays_ask_for_large_pages_and_small_ones_do_not() {
        if !std::path::Path::new("/sys/kernel/mm/transparent_hugepage").exists() {
            return; // this kernel has none
        }
        for (size, asks) in [(PAGE - 1, false), (PAGE, true), (3 * PAGE + 17, true)] {
            let layout = Layout::from_size_align(size, 64).unwrap();
            // SAFETY: the layout is not empty, and what is allocated is freed with it.
            unsafe {
                let place = LargePages.alloc(layout);
                assert_eq!(
                    flags(place as usize).split(' ').any(|flag| flag == "hg"),
                    asks,
                    "{size}"
                );
                LargePages.dealloc(place, layout);
            }
        }
    }

    #[test]
    fn an_array_that_grows_and_shrinks_keeps_its_bytes() {
        let sizes = [100, PAGE - 1, PAGE, 2 * PAGE + 5, PAGE, PAGE - 1, 7];
        let layout = |size| Layout::from_size_align(size, 8).unwrap();
        let byte = |at: usize| (at % 251) as u8;
        // SAFETY: no layout is empty; bytes are read where they were written or zeroed.
        unsafe {
            let mut place = LargePages.alloc_zeroed(layout(sizes[0]));
            for pair in sizes.windows(2) {
                (0..pair[0]).for_each(|at| place.add(at).write(byte(at)));
                place = LargePages.realloc(place, layout(pair[0]), pair[1]);
                let kept = std::slice::from_raw_parts(place, pair[0].min(pair[1]));
                assert!(kept.iter().enumerate().all(|(at, &b)| b == byte(at)), "{pair:?}");
            }
            LargePages.dealloc(place, layout(7));
            // Memory that was used before comes back zeroed.
            let place = LargePages.alloc_zeroed(layout(2 * PAGE));
            assert!(std::slice::from_raw_parts(place, 2 * PAGE).iter().all(|&b| b == 0));
            LargePages.dealloc(place, layout(2 * PAGE));
        }
    }
}
