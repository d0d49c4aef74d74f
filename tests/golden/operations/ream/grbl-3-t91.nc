(program ream-3-t91, Grbl 1.1)
(part ream, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(pin: D6 H7 [0/+0.012], made to 6.006)
(dowel: D6 H7 [0/+0.012], made to 6.006)
(drills go 2.04 mm below the stock: leave room under the)
(holes)
(reamers go 1.20 mm below the stock: leave room under the)
(holes)
(file 3 of 3, load T91 reamer-6, touch it off on the stock)
(as Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T91 D 6 mm: reamer-6, reamer)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: pin: ream)
T91
G54 S1061 M3
G0 X-10 Y0
G49
Z5
M8
Z1
G1 Z-5.2 F190
Z1
G0 Z5
(operation: dowel: ream)
X10
Z1
G1 Z-5.2
Z1
G0 Z5
M9
M5
G53 G0 Z-2
M30
