/* The ring of firmware/rt/spsc_ring.h under every interleaving of its two threads: the consumer sees all
   items in order and the producer never overwrites a slot that is being read.

   Memory order: a store with release may reach the other side later, but never before what precedes it in
   its own thread; an index that is read with acquire is therefore at worst old. So each side here reads the
   other's index once, keeps it, and works on. -DWRONG_PUBLISH publishes the head before the slot is written,
   as a relaxed store could; -DWRONG_FULL lets the producer believe one slot too many. Both must fail. */
#define CAPACITY 2
#define ITEMS 5

byte slot[CAPACITY];
byte head = 0;       /* items ever published */
byte tail = 0;       /* items ever popped */
bool reading = false;
byte read_slot = 0;

proctype Producer() {
  byte sent = 0, seen = 0;
  do
  :: sent == ITEMS -> break
  :: sent < ITEMS ->
     if
     :: sent - seen == CAPACITY -> seen = tail    /* acquire */
     :: else -> skip
     fi;
     if
#ifdef WRONG_FULL
     :: sent - seen > CAPACITY -> skip
     :: sent - seen <= CAPACITY ->
#else
     :: sent - seen == CAPACITY -> skip           /* full: refused */
     :: sent - seen < CAPACITY ->
#endif
#ifdef WRONG_PUBLISH
        head = sent + 1;
#endif
        assert(!(reading && read_slot == sent % CAPACITY));
        slot[sent % CAPACITY] = sent + 1;
#ifndef WRONG_PUBLISH
        head = sent + 1;                          /* release */
#endif
        sent++
     fi
  od
}

proctype Consumer() {
  byte got = 0, seen = 0, value = 0;
  do
  :: got == ITEMS -> break
  :: got < ITEMS ->
     if
     :: got == seen -> seen = head                /* acquire */
     :: else -> skip
     fi;
     if
     :: got == seen -> skip                       /* empty */
     :: got < seen ->
        atomic { read_slot = got % CAPACITY; reading = true };
        value = slot[got % CAPACITY];
        assert(value == got + 1);                 /* complete, in order, nothing lost, nothing twice */
        reading = false;
        got++;
        tail = got                                /* release */
     fi
  od
}

init { atomic { run Producer(); run Consumer() } }
