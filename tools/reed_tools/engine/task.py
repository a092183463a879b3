"""What a scheduler passes on to its workers."""


def travelling():
    """A function without a name in a module goes by value: a scheduler that others share need not have Reed; its workers do."""

    def call(function: bytes, item: bytes, session: str):
        import pickle

        from reed_tools.engine import worker

        return worker.call(pickle.loads(function), pickle.loads(item), session)

    return call
