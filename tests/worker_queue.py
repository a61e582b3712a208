"""Which worker runs which file: as `--dist loadfile` has it, without going through thousands of tests for each one."""

from __future__ import annotations

from typing import Any

from xdist.scheduler import LoadFileScheduling


class Collected(list[str]):
    """What a worker has collected: where a test is in it is known at once."""

    def __init__(self, tests: list[str]) -> None:
        super().__init__(tests)
        self._places = {test: place for place, test in enumerate(tests)}

    def index(self, test: str, *_: Any) -> int:
        """Its place. Raises KeyError for one that was not collected."""
        return self._places[test]


class ByFile(LoadFileScheduling):
    """All tests of a file are run by one worker; files that are done are forgotten."""

    def add_node_collection(self, node: Any, collection: list[str]) -> None:
        """What a worker has collected."""
        super().add_node_collection(node, collection)
        if node in self.registered_collections:
            self.registered_collections[node] = Collected(collection)

    def mark_test_complete(self, node: Any, item_index: int, duration: float = 0) -> None:
        """A test is done, and with the last one its file."""
        test, files = self.registered_collections[node][item_index], self.assigned_work[node]
        file = self._split_scope(test)
        files[file][test] = True
        if all(files[file].values()):
            del files[file]
        self._reschedule(node)
